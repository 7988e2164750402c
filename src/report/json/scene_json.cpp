#include "report/json/scene_json.hpp"

namespace tactile_net::report {

Json effects_json(const std::vector<std::pair<std::string_view, bool>>& effects) {
  Json simulated = Json::array();
  Json absent = Json::array();
  for (const auto& [effect, present] : effects) (present ? simulated : absent).push_back(effect);
  return {{"simulated", simulated}, {"absent", absent}};
}

Json scene_json(const DocumentKind& kind, const Scene& scene) {
  Json json = document(kind);
  json["scene"] = scene.file;
  json["effects"] = effects_json(effects(scene));
  if (scene.units) json["units"] = units_json(*scene.units);
  if (scene.time)
    json["frame"] = {
        {"index", scene.frame}, {"of", scene.time->frames}, {"t", scene.time->time(scene.frame)}};
  return json;
}

UnitsTold units_told(const Units& units, Dimension force) {
  return {.length = si_unit(Dimension::length),
          .stress = si_unit(Dimension::stress),
          .force = si_unit(force),
          .stated = {.length = units.length.name,
                     .modulus = units.modulus.name,
                     .stress = units.stress.name,
                     .force = units.force.name}};
}

Json units_json(const Units& units) { return as_json(units_told(units, Dimension::force)); }
Json skin_units_json(const Units& units) {
  return as_json(units_told(units, Dimension::point_force));
}

}  // namespace tactile_net::report
