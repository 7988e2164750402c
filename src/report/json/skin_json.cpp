#include "tactile_net/report/json/skin_json.hpp"

#include <span>
#include <vector>

#include "report/json/contact_json.hpp"
#include "report/json/data_json.hpp"
#include "report/json/document.hpp"
#include "report/json/finding_json.hpp"
#include "report/json/network_values.hpp"
#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::report {

Json scene_json(const DocumentKind& kind, const SkinScene& scene) {
  Json json = document(kind);
  json["scene"] = scene.file;
  json["effects"] = effects_json(effects(scene));
  if (scene.units) json["units"] = skin_units_json(*scene.units);
  if (scene.time)
    json["frame"] = {
        {"index", scene.frame}, {"of", scene.time->frames}, {"t", scene.time->time(scene.frame)}};
  return json;
}

namespace {

Json list(std::span<const double> values) {
  return values.empty() ? Json(nullptr) : Json(std::vector(values.begin(), values.end()));
}

Json fields(const std::vector<double>& values, const SurfaceGrid& grid) {
  if (values.empty()) return nullptr;
  Json json = Json::object();
  for (const Traction which : skin_tractions)
    json[std::string(name(which))] = list(lab::component(values, grid, which));
  return json;
}

Json wrench_json(const SkinWrench& wrench) {
  const auto centre = wrench.centre();
  return {{"normal", wrench.force[0]},
          {"tangential_y", wrench.force[1]},
          {"tangential_z", wrench.force[2]},
          {"centre", centre ? Json{centre->y, centre->z} : Json(nullptr)},
          {"torsion", number_or_null(wrench.torsion())}};
}

Json skin_friction_json(const std::optional<SkinFriction>& friction) {
  if (!friction) return nullptr;
  return {{"ratio", uncertain_json(friction->ratio)},
          {"least_limit", uncertain_json(friction->least_limit)},
          {"contacts", friction->contacts},
          {"centre", friction->wrench
                         ? pair_json(friction->wrench->centre_y, friction->wrench->centre_z)
                         : Json(nullptr)},
          {"slip_margin", uncertain_or_null(friction->slip_margin)}};
}

/// Null with one component, which nothing weighs.
Json weight_json(const SkinScene& scene, const lab::ChosenAlpha& alpha) {
  if (components(scene) == 1) return nullptr;
  return number_or_null(alpha.tangential_weight ? alpha.tangential_weight
                                                : scene.reconstruct.tangential_weight);
}

Json grid_json(const SurfaceGrid& grid) {
  Json y = Json::array();
  Json z = Json::array();
  for (std::size_t row = 0; row < grid.rows; ++row) y.push_back(grid.y(row));
  for (std::size_t column = 0; column < grid.columns; ++column) z.push_back(grid.z(column));
  return {{"y", y}, {"z", z}, {"spacing", {grid.spacing_y, grid.spacing_z}}};
}

Json answer_json(const lab::SkinExperiment& experiment) {
  const lab::FrameAnswer& answer = *experiment.answer;
  Json json = {{"alpha", answer.alpha.value},
               {"alpha_rule", source(answer.alpha)},
               {"tangential_weight", weight_json(experiment.scene, answer.alpha)},
               {"verdict", name(answer.verdict)},
               {"tractions", fields(answer.tractions, experiment.grid)},
               {"deviations", fields(answer.deviations, experiment.grid)},
               {"cells", answer.cells},
               {"contacts", answer.patches.size()},
               {"unseen", answer.unseen},
               {"resultant", found_json(answer.wrench)},
               {"patches", skin_contacts_json(answer.patches)},
               {"friction", skin_friction_json(answer.friction)},
               {"ellipse", ellipse_json(answer.ellipse)},
               {"relative_error",
                {finite_or_null(experiment.relative[0]), finite_or_null(experiment.relative[1]),
                 finite_or_null(experiment.relative[2])}},
               {"condition", finite_or_null(answer.condition->value)},
               {"noise",
                {{"stated", number_or_null(answer.noise.stated_rms)},
                 {"residual", finite_or_null(answer.noise.residual_rms)},
                 {"model", finite_or_null(answer.noise.model_rms)}}},
               {"data", data_json(*answer.data)},
               {"seconds",
                {{"setup", finite_or_null(experiment.setup_seconds)},
                 {"frame", finite_or_null(experiment.frame_seconds)}}}};
  if (const auto& iteration = answer.iteration)
    json["iteration"] = {{"steps", iteration->steps},
                         {"estimate", finite_or_null(iteration->estimate)},
                         {"bands",
                          {{"tractions", iteration->bands.tractions},
                           {"least", finite_or_null(iteration->bands.least)},
                           {"most", finite_or_null(iteration->bands.most)}}}};
  json["constraints"] = nullptr;
  if (const auto& cone = answer.cone)
    json["constraints"] = {{"residual", cone->residual},
                           {"iterations", cone->iterations},
                           {"apart", cone->separation},
                           {"sliding", cone->slip},
                           {"sticking", cone->stick}};
  return json;
}

Json circuit_json(const lab::SkinCircuitResult& circuit) {
  Json json = {{"verdict", name(circuit.verdict())},
               {"relative_error",
                {finite_or_null(circuit.relative[0]), finite_or_null(circuit.relative[1]),
                 finite_or_null(circuit.relative[2])}},
               {"network", nullptr}};
  if (circuit.relaxation) json["network"] = network_json(*circuit.relaxation);
  if (!circuit.refusal.empty()) json["failure"] = circuit.refusal;
  return json;
}

}  // namespace

std::string experiment_json(const lab::SkinExperiment& experiment) {
  Json json = scene_json(kind::skin_run, experiment.scene);
  json["grid"] = grid_json(experiment.grid);
  json["truth"] = fields(experiment.frame.truth, experiment.grid);
  json["truth"]["resultant"] = wrench_json(experiment.frame.wrench);
  json["readings"] = Json::object();
  const std::span<const double> readings = experiment.frame.readings;
  for (const Channel& channel : channels(experiment.scene.sensor))
    json["readings"][channel.name] = list(readings.subspan(channel.first, channel.count));
  json["answer"] = experiment.answer ? answer_json(experiment) : Json(nullptr);
  add_remarks(json, remarks_in_words(experiment));
  if (!experiment.refusal.empty()) json["failure"] = experiment.refusal;
  if (experiment.network) json["circuit"] = circuit_json(*experiment.network);
  return text_of(json);
}

std::string simulate_json(const SkinScene& scene, const lab::RecordedFrames& recorded,
                          std::span<const std::string> columns) {
  Json json = scene_json(kind::simulate, scene);
  json.erase("frame");
  json["frames"] = recorded.frames;
  json["rate"] = scene.time ? Json(scene.time->rate) : Json(nullptr);
  json["columns"] = columns;
  json["frames_cut_off"] = recorded.cut_off;
  return text_of(json);
}

std::string recording_json(const lab::SkinRecordingAnswer& recording, const std::string& readings) {
  Json json = document(kind::skin_solve);
  json["scene"] = recording.scene.file;
  json["readings"] = readings;
  if (recording.scene.units) json["units"] = skin_units_json(*recording.scene.units);
  json["grid"] = grid_json(recording.grid);
  json["hardest"] = recording.answer ? Json(recording.hardest) : Json(nullptr);
  json["findings"] = findings_json(recording.findings, recording.scene);
  json["events"] = events_json(recording.tracker.events());
  json["frames"] = Json::array();
  for (const lab::SkinRecordingAnswer::Frame& frame : recording.frames) {
    Json one = {{"t", finite_or_null(frame.time)},
                {"verdict", name(frame.verdict)},
                {"missing", frame.missing     ? Json("skipped")
                            : frame.estimated ? Json("estimated")
                                              : Json(nullptr)},
                {"alpha", nullptr},
                {"alpha_rule", nullptr},
                {"tangential_weight", nullptr},
                {"resultant", nullptr},
                {"friction", uncertain_or_null(frame.friction)},
                {"patches", skin_contacts_json(frame.contacts)},
                {"data", nullptr}};
    if (!frame.missing) {
      one["data"] = doubts_json(frame.data);
      one["alpha"] = frame.alpha.value;
      one["alpha_rule"] = source(frame.alpha);
      one["tangential_weight"] = weight_json(recording.scene, frame.alpha);
      one["resultant"] = found_json(frame.wrench);
    }
    json["frames"].push_back(std::move(one));
  }
  return text_of(json);
}

}  // namespace tactile_net::report
