#include "tactile_net/report/json/network_json.hpp"

#include "report/json/network_values.hpp"
#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/opamp_words.hpp"
#include "tactile_net/report/words/parts_words.hpp"

namespace tactile_net::report {
namespace {

Json elements_of(const ElementCounts& elements) {
  return {{"resistors", elements.resistors},   {"negative_resistors", elements.negative_resistors},
          {"opamps", elements.opamps},         {"inductors", elements.inductors},
          {"capacitors", elements.capacitors}, {"devices", elements.devices},
          {"sources", elements.sources}};
}

Json theorem_json(const Theorem& theorem) {
  return {{"name", theorem.name},
          {"statement", theorem.statement},
          {"holds", theorem.holds()},
          {"condition", condition_in_words(theorem)}};
}

Json errors_json(const StaticErrors& errors) {
  const auto of_inputs = [](const InputErrors& one) -> Json {
    return {{"either_sign", one.either_sign}, {"alike", one.alike}};
  };
  return {{"offset", of_inputs(errors.offset)},
          {"bias_current", of_inputs(errors.bias_current)},
          {"common_mode", errors.common_mode},
          {"output_resistance", errors.output_resistance}};
}

Json motion_json(const lab::ContactMotion& motion) {
  return {{"delay_seconds", motion.delay},
          {"lag", lab::ContactMotion::lag},
          {"speed", motion.speed},
          {"slowest_hertz", motion.slowest_hertz},
          {"sampling_hertz", lab::ContactMotion::sampling_hertz},
          {"sampled_speed", motion.sampled_speed}};
}

Json certificate(const Certificate& c) {
  Json json = {{"realization", name(c.realization)},
               {"stability", name(c.stability)},
               {"theorem", theorem_json(c.theorem)},
               {"lambda_min", c.smallest_eigenvalue},
               {"condition", finite_or_null(c.condition)},
               {"tolerance_margin", number_or_null(c.tolerance_margin)},
               {"margin_for_any_bandwidth", c.margin_for_any_bandwidth},
               {"elements", elements_of(c.elements)},
               {"ohm", {c.least_ohm, c.greatest_ohm}},
               {"largest_voltage", c.largest_voltage},
               {"power", c.power},
               {"dynamics", nullptr},
               {"noise", nullptr},
               {"slewing", c.slewing ? theorem_json(*c.slewing) : Json(nullptr)},
               {"static_errors", c.errors ? errors_json(*c.errors) : Json(nullptr)},
               {"output_current", nullptr},
               {"proposal", nullptr},
               {"warnings", Json::array()}};
  if (c.ladder) json["ladder"] = true;
  for (const CircuitRemark& remark : c.remarks) json["warnings"].push_back(in_words(remark));
  if (c.noise)
    json["noise"] = {{"largest_volts", c.noise->largest},
                     {"total_volts", c.noise->total},
                     {"relative", finite_or_null(c.noise->relative)},
                     {"thermal_share", c.noise->thermal},
                     {"flicker_share", c.noise->flicker}};
  if (c.output_current)
    json["output_current"] = {{"ampere", c.output_current->largest},
                              {"opamp", c.output_current->opamp}};
  if (c.proposal)
    json["proposal"] = {{"volts", c.proposal->volts},
                        {"volts_by", name(c.proposal->volts_by)},
                        {"siemens", c.proposal->siemens},
                        {"noise", c.proposal->noise},
                        {"offset", c.proposal->offset}};
  if (c.dynamics)
    json["dynamics"] = {{"states", c.dynamics->states},
                        {"slowest_pole", c.dynamics->slowest},
                        {"damping", c.dynamics->damping},
                        {"accuracy", c.accuracy},
                        {"settling_seconds", number_or_null(c.dynamics->settling_seconds)},
                        {"unslewed_seconds", number_or_null(c.dynamics->unslewed_seconds)},
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

Json transient_json(const Transient& transient) {
  return {{"judgement", name(transient.end)},
          {"settling_seconds", number_or_null(transient.settling_seconds)},
          {"growth", transient.growth},
          {"growing_mode", list_or_null(transient.mode)},
          {"end_error", transient.end_error},
          {"simulated_seconds", transient.simulated},
          {"ngspice_seconds", transient.seconds}};
}

Json parts_json(const lab::PartsList& list) {
  Json classes = Json::array();
  for (const PartClass& one : list.wanted.classes)
    classes.push_back({{"tolerance", one.tolerance}, {"price", one.price}});
  Json candidates = Json::array();
  for (const auto& one : list.candidates) {
    candidates.push_back({{"realization", name(one.realization)},
                          {"opamps", one.opamps},
                          {"stable_with_opamps", one.stable()},
                          {"met", one.list.met},
                          {"counts", one.list.counts},
                          {"price", one.price},
                          {"pairs", one.pairs},
                          {"rounding", one.rounding},
                          {"resistors_price", one.resistors_price},
                          {"resistors_price_bound", one.resistors_bound},
                          {"opamps_error", one.opamps_alone.total},
                          {"opamps_p95_error", finite_or_null(one.opamps_p95)},
                          {"p95_error", one.p95 ? finite_or_null(*one.p95) : Json(nullptr)},
                          {"builds", one.builds},
                          {"within", one.within},
                          {"share_within", {one.interval().first, one.interval().second}}});
    if (one.ladder) candidates.back()["ladder"] = true;
  }
  Json json = {{"target", list.wanted.target},
               {"text", in_words(list)},
               {"opamp_price", list.opamp_price},
               {"series", "E" + std::to_string(static_cast<int>(list.series))},
               {"loads", list.loads},
               {"classes", classes},
               {"candidates", candidates},
               {"choice", list.choice ? Json(name(list.chosen().realization)) : Json(nullptr)}};
  if (list.choice && list.chosen().ladder) json["choice_ladder"] = true;
  return json;
}

}  // namespace

Json network_json(const lab::Relaxation& relaxation) {
  Json json = {{"realization", name(relaxation.realization)},
               {"nodes", relaxation.nodes},
               {"elements", elements_of(relaxation.elements)},
               {"names", relaxation.names},
               {"voltages", relaxation.voltages},
               {"difference_to_direct", relaxation.difference},
               {"difference_limit", relaxation.explained.limit},
               {"difference_of_devices", relaxation.explained.curves},
               {"difference_predicted", number_or_null(relaxation.explained.predicted)},
               {"lambda_min", relaxation.smallest_eigenvalue},
               {"stable", relaxation.stable},
               {"settling_seconds", nullptr},
               {"ngspice_seconds", relaxation.ngspice_seconds},
               {"certificate", nullptr},
               {"transient", nullptr},
               {"tolerance", nullptr},
               {"warnings", warnings_of(relaxation)}};
  if (relaxation.certificate) json["certificate"] = certificate(*relaxation.certificate);
  if (relaxation.transient) {
    json["settling_seconds"] = number_or_null(relaxation.transient->settling_seconds);
    json["transient"] = transient_json(*relaxation.transient);
  }
  if (relaxation.tolerance) {
    json["tolerance"] = tolerance_json(relaxation.tolerance->result);
    json["tolerance"]["replayed"] = relaxation.tolerance->replayed;
    json["tolerance"]["replay_difference"] = relaxation.tolerance->difference;
  }
  return json;
}

namespace {

Json any_scene_json(const DocumentKind& kind, const AnyScene& any) {
  return std::visit([&](const auto& scene) { return scene_json(kind, scene); }, any);
}

}  // namespace

std::string relaxation_json(const AnyScene& scene, const lab::Relaxation& relaxation) {
  Json json = any_scene_json(kind::relax, scene);
  json["network"] = network_json(relaxation);
  return text_of(json);
}

std::string certificate_json(const lab::Certification& c) {
  Json json = any_scene_json(kind::certify, c.scene());
  json["certificate"] = certificate(c.certificate());
  json["motion"] = c.motion ? motion_json(*c.motion) : Json(nullptr);
  json["tolerance"] = c.tolerance ? tolerance_json(*c.tolerance) : Json(nullptr);
  Json candidates = Json::array();
  for (const auto& one : c.recommendation.candidates) {
    Json row = tolerance_json(one.tolerance);
    row["realization"] = name(one.realization);
    row["opamps"] = one.opamps;
    row["stable_with_opamps"] = one.stable();
    if (one.ladder) row["ladder"] = true;
    candidates.push_back(row);
  }
  json["recommendation"] = {{"text", in_words(c.recommendation)}, {"candidates", candidates}};
  json["curves_warning"] = c.curves ? Json(in_words(*c.curves)) : Json(nullptr);
  json["parts"] = c.parts ? parts_json(*c.parts) : Json(nullptr);
  return text_of(json);
}

std::string deck_answer_json(const std::string& file, const decks::DeckAnswer& answer) {
  Json nodes = Json::array();
  for (const decks::NodeAnswer& one : answer.nodes)
    nodes.push_back({{"node", one.node}, {"expected", one.expected}, {"found", one.found}});
  Json json = document(kind::deck);
  json.update(Json{{"deck", file},
                   {"nodes", nodes},
                   {"difference", finite_or_null(answer.difference)},
                   {"within", answer.within},
                   {"ngspice_seconds", answer.ngspice_seconds}});
  return text_of(json);
}

}  // namespace tactile_net::report
