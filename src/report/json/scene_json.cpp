#include "report/json/scene_json.hpp"

namespace tactile_net::report {

Json scene_json(const DocumentKind& kind, const Scene& scene) {
  Json simulated = Json::array();
  Json absent = Json::array();
  for (const auto& [effect, present] : effects(scene))
    (present ? simulated : absent).push_back(effect);
  Json json = document(kind);
  json["scene"] = scene.file;
  json["effects"] = {{"simulated", simulated}, {"absent", absent}};
  if (scene.units) json["units"] = units_json(*scene.units);
  if (scene.time)
    json["frame"] = {
        {"index", scene.frame}, {"of", scene.time->frames}, {"t", scene.time->time(scene.frame)}};
  return json;
}

Json units_json(const Units& units) {
  return {{"length", si_unit(Dimension::length)},
          {"stress", si_unit(Dimension::stress)},
          {"force", si_unit(Dimension::force)},
          {"stated",
           {{"length", units.length.name},
            {"modulus", units.modulus.name},
            {"stress", units.stress.name},
            {"force", units.force.name}}}};
}

}  // namespace tactile_net::report
