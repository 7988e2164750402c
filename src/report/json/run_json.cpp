#include "tactile_net/report/json/run_json.hpp"

#include <cmath>

#include "report/json/scene_json.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::report {
namespace {

Json component(const lab::Component& component) {
  return {{"mean_abs", component.mean_abs}, {"relative_l2", component.relative_l2}};
}

Json resultant(const UncertainResultant& resultant) {
  return {{"normal", uncertain_json(resultant.normal)},
          {"tangential", uncertain_or_null(resultant.tangential)},
          {"centre", uncertain_or_null(resultant.centre)},
          {"angle", uncertain_or_null(resultant.angle)}};
}

/// What is known of an answer's errors without the truth.
void add_uncertainty(Json& json, const lab::MethodResult& result) {
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

Json reconstruction(const lab::Experiment& experiment, const lab::MethodResult& result) {
  Json json = {{"method", name(result.method)},
               {"alpha", result.alpha ? Json(result.alpha->value) : Json(nullptr)},
               {"alpha_rule", result.alpha ? Json(source(*result.alpha)) : Json(nullptr)},
               {"verdict", name(result.verdict)},
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
    json["condition"] = result.condition ? Json(result.condition->value) : Json(nullptr);
    json["condition_kind"] = result.condition ? Json(name(result.condition->kind)) : Json(nullptr);
    add_uncertainty(json, result);
  }
  json["warnings"] = remarks_in_words(experiment, result);
  if (const std::string failure = failure_in_words(experiment, result); !failure.empty())
    json["failure"] = failure;
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

Json elements_of(const ElementCounts& elements) {
  return {{"resistors", elements.resistors},   {"negative_resistors", elements.negative_resistors},
          {"opamps", elements.opamps},         {"inductors", elements.inductors},
          {"capacitors", elements.capacitors}, {"devices", elements.devices},
          {"sources", elements.sources}};
}

Json certificate(const Certificate& c) {
  Json json = {{"realization", name(c.realization)},
               {"stability", name(c.stability)},
               {"theorem",
                {{"name", c.theorem.name},
                 {"statement", c.theorem.statement},
                 {"holds", c.theorem.holds},
                 {"condition", c.theorem.condition}}},
               {"lambda_min", c.smallest_eigenvalue},
               {"condition", finite_or_null(c.condition)},
               {"tolerance_margin", number_or_null(c.tolerance_margin)},
               {"margin_for_any_bandwidth", c.margin_for_any_bandwidth},
               {"elements", elements_of(c.elements)},
               {"ohm", {c.least_ohm, c.greatest_ohm}},
               {"largest_voltage", c.largest_voltage},
               {"power", c.power},
               {"dynamics", nullptr},
               {"warnings", c.warnings}};
  if (c.dynamics)
    json["dynamics"] = {{"states", c.dynamics->states},
                        {"slowest_pole", c.dynamics->slowest},
                        {"damping", c.dynamics->damping},
                        {"accuracy", c.accuracy},
                        {"settling_seconds", number_or_null(c.dynamics->settling_seconds)},
                        {"growing_mode", list_or_null(c.dynamics->mode)}};
  return json;
}

Json tolerance_json(const ToleranceResult& result) {
  Json worst = Json::array();
  for (const Contribution& one : result.worst)
    worst.push_back({{"component", one.component}, {"share", one.share}});
  return {{"trials", result.trials},
          {"stable", result.stable},
          {"accurate", result.accurate},
          {"yield", result.yield()},
          {"median_error", finite_or_null(result.median)},
          {"p95_error", finite_or_null(result.p95)},
          {"predicted_error", result.predicted},
          {"worst_components", worst}};
}

Json judged_json(const Judged& judged) {
  return {{"judgement", name(judged.judgement)},
          {"settling_seconds", number_or_null(judged.settling_seconds)},
          {"growth", judged.growth},
          {"growing_mode", list_or_null(judged.mode)},
          {"end_error", judged.end_error},
          {"simulated_seconds", judged.simulated},
          {"ngspice_seconds", judged.seconds}};
}

Json network(const lab::Relaxation& relaxation) {
  Json json = {{"realization", name(relaxation.realization)},
               {"nodes", relaxation.nodes},
               {"elements", elements_of(relaxation.elements)},
               {"voltages", relaxation.voltages},
               {"difference_to_direct", relaxation.difference},
               {"difference_limit", relaxation.limit},
               {"difference_of_devices", relaxation.curves},
               {"difference_predicted", number_or_null(relaxation.predicted)},
               {"lambda_min", relaxation.smallest_eigenvalue},
               {"stable", relaxation.stable},
               {"settling_seconds", nullptr},
               {"ngspice_seconds", relaxation.ngspice_seconds},
               {"certificate", nullptr},
               {"transient", nullptr},
               {"tolerance", nullptr},
               {"warnings", relaxation.warnings}};
  if (relaxation.certificate) json["certificate"] = certificate(*relaxation.certificate);
  if (relaxation.judged) {
    json["settling_seconds"] = number_or_null(relaxation.judged->settling_seconds);
    json["transient"] = judged_json(*relaxation.judged);
  }
  if (relaxation.tolerance) {
    json["tolerance"] = tolerance_json(relaxation.tolerance->result);
    json["tolerance"]["replayed"] = relaxation.tolerance->replayed;
    json["tolerance"]["replay_difference"] = relaxation.tolerance->difference;
  }
  return json;
}

}  // namespace

std::string experiment_json(const lab::Experiment& experiment) {
  const Scene& scene = experiment.scene;
  const TractionField& truth = experiment.frame.truth;
  Json json = scene_json(scene);
  json["positions"] = positions(scene.sensor);
  json["truth"] = {{"normal", truth.normal},
                   {"tangential", list_or_null(truth.tangential)},
                   {"force", experiment.frame.force}};
  json["readings"] = Json::object();
  auto begin = experiment.frame.readings.begin();
  for (const Channel& channel : channels(scene.sensor)) {
    const auto end = begin + static_cast<std::ptrdiff_t>(scene.sensor.count);
    json["readings"][channel.name] = std::vector<double>(begin, end);
    begin = end;
  }
  json["reconstructions"] = Json::array();
  for (const lab::MethodResult& result : experiment.results)
    json["reconstructions"].push_back(reconstruction(experiment, result));
  json["alpha_sweep"] = experiment.sweep ? alpha_sweep(*experiment.sweep) : Json(nullptr);
  json["network"] = experiment.relaxation ? network(*experiment.relaxation) : Json(nullptr);
  json["warnings"] = in_words(experiment.frame);
  return text_of(json);
}

std::string relaxation_json(const Scene& scene, const lab::Relaxation& relaxation) {
  Json json = scene_json(scene);
  json["network"] = network(relaxation);
  return text_of(json);
}

std::string certificate_json(const lab::Certification& c) {
  Json json = scene_json(c.scene);
  json["certificate"] = certificate(c.certificate);
  json["tolerance"] = c.tolerance ? tolerance_json(*c.tolerance) : Json(nullptr);
  Json candidates = Json::array();
  for (const auto& one : c.recommendation.candidates) {
    Json row = tolerance_json(one.tolerance);
    row["realization"] = name(one.realization);
    row["opamps"] = one.opamps;
    candidates.push_back(row);
  }
  json["recommendation"] = {{"text", c.recommendation.text}, {"candidates", candidates}};
  return text_of(json);
}

std::string deck_answer_json(const std::string& file, const lab::DeckAnswer& answer) {
  Json nodes = Json::array();
  for (const lab::NodeAnswer& one : answer.nodes)
    nodes.push_back({{"node", one.node}, {"expected", one.expected}, {"found", one.found}});
  const Json json = {{"tactile_net", version()}, {"deck", file},
                     {"nodes", nodes},           {"difference", finite_or_null(answer.difference)},
                     {"within", answer.within},  {"ngspice_seconds", answer.ngspice_seconds}};
  return text_of(json);
}

}  // namespace tactile_net::report
