#include "result_json.hpp"

#include "scene_json.hpp"

namespace tactile_net::tool {
namespace {

Json number_or_null(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

Json list_or_null(const std::vector<double>& values) {
  return values.empty() ? Json(nullptr) : Json(values);
}

Json component(const Component& component) {
  return {{"mean_abs", component.mean_abs}, {"relative_l2", component.relative_l2}};
}

Json uncertain(const Uncertain& number) {
  return {{"value", number.value}, {"deviation", number.deviation}};
}

Json uncertain_or_null(const std::optional<Uncertain>& number) {
  return number ? uncertain(*number) : Json(nullptr);
}

Json resultant(const UncertainResultant& resultant) {
  return {{"normal", uncertain(resultant.normal)},
          {"tangential", uncertain_or_null(resultant.tangential)},
          {"centre", uncertain_or_null(resultant.centre)},
          {"angle", uncertain_or_null(resultant.angle)}};
}

/// What is known of an answer's errors without the truth.
void add_uncertainty(Json& json, const MethodResult& result) {
  json["error_bound"] = number_or_null(result.error_bound);
  json["deviation"] = result.normal.deviation.empty()
                          ? Json(nullptr)
                          : Json{{"normal", result.normal.deviation},
                                 {"tangential", list_or_null(result.tangential.deviation)}};
  json["resultant"] = result.resultant ? resultant(*result.resultant) : Json(nullptr);
  json["noise"] = nullptr;
  if (result.noise)
    json["noise"] = {{"stated", number_or_null(result.noise->stated_rms)},
                     {"residual", result.noise->residual_rms},
                     {"model", result.noise->model_rms}};
  if (result.constrained)
    json["constraints"] = {{"kkt_residual", result.constrained->kkt_residual},
                           {"iterations", result.constrained->iterations},
                           {"free", result.constrained->free.size()}};
}

Json reconstruction(const MethodResult& result) {
  Json json = {{"method", name(result.method)},
               {"alpha", number_or_null(result.alpha)},
               {"alpha_rule", result.alpha_rule.empty() ? Json(nullptr) : Json(result.alpha_rule)},
               {"verdict", result.verdict},
               {"normal", list_or_null(result.normal.traction)},
               {"tangential", list_or_null(result.tangential.traction)}};
  if (!result.has_answer()) {
    for (const char* key : {"error", "force", "seconds", "condition"}) json[key] = nullptr;
  } else {
    json["error"] = component(result.normal);
    if (!result.tangential.traction.empty())
      json["error"]["tangential"] = component(result.tangential);
    json["force"] = result.force;
    json["seconds"] = {{"setup", result.setup_seconds}, {"frame", result.frame_seconds}};
    json["condition"] = number_or_null(result.condition);
    add_uncertainty(json, result);
  }
  json["warnings"] = result.warnings;
  if (!result.failure.empty()) json["failure"] = result.failure;
  return json;
}

Json alpha_sweep(const AlphaSweep& sweep) {
  Json json = {{"alphas", sweep.alphas}, {"rules", Json::array()}};
  for (const AlphaSweep::Curve& curve : sweep.curves)
    json["rules"].push_back({{"rule", name(curve.rule)},
                             {"alpha", curve.choice.alpha},
                             {"verdict", name(curve.choice.verdict)},
                             {"values", curve.values}});
  return json;
}

Json network(const Relaxation& relaxation) {
  const ElementCounts& elements = relaxation.elements;
  return {{"realization", name(relaxation.realization)},
          {"nodes", relaxation.nodes},
          {"elements",
           {{"resistors", elements.resistors},
            {"negative_resistors", elements.negative_resistors},
            {"opamps", elements.opamps},
            {"inductors", elements.inductors},
            {"capacitors", elements.capacitors},
            {"sources", elements.sources}}},
          {"voltages", relaxation.voltages},
          {"difference_to_direct", relaxation.difference},
          {"difference_limit", relaxation.limit},
          {"lambda_min", relaxation.smallest_eigenvalue},
          {"stable", relaxation.stable},
          {"settling_seconds", nullptr},
          {"ngspice_seconds", relaxation.ngspice_seconds}};
}

}  // namespace

std::string experiment_json(const Experiment& experiment) {
  const Scene& scene = experiment.scene;
  const TractionField& truth = experiment.simulation.truth;
  Json json = scene_json(scene);
  json["positions"] = positions(scene.sensor);
  json["truth"] = {{"normal", truth.normal},
                   {"tangential", list_or_null(truth.tangential)},
                   {"force", experiment.force}};
  json["readings"] = Json::object();
  auto begin = experiment.simulation.readings.begin();
  for (const Channel& channel : channels(scene.sensor)) {
    const auto end = begin + static_cast<std::ptrdiff_t>(scene.sensor.count);
    json["readings"][channel.name] = std::vector<double>(begin, end);
    begin = end;
  }
  json["reconstructions"] = Json::array();
  for (const MethodResult& result : experiment.results)
    json["reconstructions"].push_back(reconstruction(result));
  json["alpha_sweep"] = experiment.sweep ? alpha_sweep(*experiment.sweep) : Json(nullptr);
  json["network"] = experiment.relaxation ? network(*experiment.relaxation) : Json(nullptr);
  json["warnings"] = experiment.simulation.warnings;
  return json.dump(1) + '\n';
}

std::string relaxation_json(const Scene& scene, const Relaxation& relaxation) {
  Json json = scene_json(scene);
  json["network"] = network(relaxation);
  return json.dump(1) + '\n';
}

}  // namespace tactile_net::tool
