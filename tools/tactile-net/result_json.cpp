#include "result_json.hpp"

#include <nlohmann/json.hpp>

namespace tactile_net::tool {
namespace {

using Json = nlohmann::ordered_json;

Json head(const Scene& scene) {
  Json simulated = Json::array();
  Json absent = Json::array();
  for (const auto& [effect, present] : effects(scene))
    (present ? simulated : absent).push_back(effect);
  return {{"tactile_net", TACTILE_NET_VERSION},
          {"scene", scene.file},
          {"effects", {{"simulated", simulated}, {"absent", absent}}}};
}

Json number_or_null(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

Json list_or_null(const std::vector<double>& values) {
  return values.empty() ? Json(nullptr) : Json(values);
}

Json reconstruction(const MethodResult& result) {
  Json json = {{"method", name(result.method)},
               {"alpha", number_or_null(result.alpha)},
               {"alpha_rule", result.alpha ? Json("given") : Json(nullptr)},
               {"verdict", result.verdict},
               {"normal", list_or_null(result.normal)},
               {"tangential", nullptr}};
  if (result.normal.empty()) {
    json["error"] = nullptr;
    json["force"] = nullptr;
    json["seconds"] = nullptr;
    json["condition"] = nullptr;
  } else {
    json["error"] = {{"mean_abs", result.mean_abs}, {"relative_l2", result.relative_l2}};
    json["force"] = result.force;
    json["seconds"] = {{"setup", result.setup_seconds}, {"frame", result.frame_seconds}};
    json["condition"] = result.condition;
  }
  json["warnings"] = result.warnings;
  if (!result.failure.empty()) json["failure"] = result.failure;
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
  Json json = head(scene);
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
  json["network"] = experiment.relaxation ? network(*experiment.relaxation) : Json(nullptr);
  json["warnings"] = experiment.simulation.warnings;
  return json.dump(1) + '\n';
}

std::string relaxation_json(const Scene& scene, const Relaxation& relaxation) {
  Json json = head(scene);
  json["network"] = network(relaxation);
  return json.dump(1) + '\n';
}

}  // namespace tactile_net::tool
