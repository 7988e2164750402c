#include "tactile_net/report/json/skin_json.hpp"

#include <span>
#include <vector>

#include "report/json/document.hpp"
#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::report {
namespace {

Json scene_json(const DocumentKind& kind, const SkinScene& scene) {
  Json json = document(kind);
  json["scene"] = scene.file;
  if (scene.units) {
    json["units"] = units_json(*scene.units);
    json["units"]["force"] = si_unit(Dimension::point_force);
  }
  if (scene.time)
    json["frame"] = {
        {"index", scene.frame}, {"of", scene.time->frames}, {"t", scene.time->time(scene.frame)}};
  return json;
}

Json list(std::span<const double> values) {
  return values.empty() ? Json(nullptr) : Json(std::vector(values.begin(), values.end()));
}

Json fields(const std::vector<double>& values, const SkinGrid& grid) {
  if (values.empty()) return nullptr;
  Json json = Json::object();
  for (const SkinTraction which : skin_tractions)
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

Json grid_json(const SkinGrid& grid) {
  Json y = Json::array();
  Json z = Json::array();
  for (std::size_t row = 0; row < grid.rows; ++row) y.push_back(grid.y(row));
  for (std::size_t column = 0; column < grid.columns; ++column) z.push_back(grid.z(column));
  return {{"y", y}, {"z", z}, {"spacing", {grid.spacing_y, grid.spacing_z}}};
}

Json answer_json(const lab::SkinExperiment& experiment) {
  const lab::SkinAnswer& answer = *experiment.answer;
  Json json = {{"alpha", answer.alpha.value},
               {"alpha_rule", source(answer.alpha)},
               {"verdict", name(answer.verdict)},
               {"tractions", fields(answer.tractions, experiment.grid)},
               {"deviations", fields(answer.deviations, experiment.grid)},
               {"resultant", wrench_json(answer.wrench)},
               {"relative_error",
                {finite_or_null(experiment.relative[0]), finite_or_null(experiment.relative[1]),
                 finite_or_null(experiment.relative[2])}},
               {"condition", finite_or_null(answer.condition)},
               {"noise",
                {{"stated", number_or_null(answer.noise.stated_rms)},
                 {"residual", finite_or_null(answer.noise.residual_rms)},
                 {"model", finite_or_null(answer.noise.model_rms)}}},
               {"seconds",
                {{"setup", finite_or_null(experiment.setup_seconds)},
                 {"frame", finite_or_null(experiment.frame_seconds)}}}};
  json["constraints"] = nullptr;
  if (const auto& cone = answer.cone)
    json["constraints"] = {{"residual", cone->residual},
                           {"iterations", cone->iterations},
                           {"apart", cone->apart},
                           {"sliding", cone->sliding},
                           {"sticking", cone->sticking}};
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
  for (const SkinChannel& channel : channels(experiment.scene.sensor))
    json["readings"][channel.name] = list(readings.subspan(channel.first, channel.count));
  json["answer"] = experiment.answer ? answer_json(experiment) : Json(nullptr);
  json["warnings"] = warnings(experiment);
  if (!experiment.refusal.empty()) json["failure"] = experiment.refusal;
  return text_of(json);
}

}  // namespace tactile_net::report
