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
  if (scene.time)
    json["frame"] = {
        {"index", scene.frame}, {"of", scene.time->frames}, {"t", scene.time->time(scene.frame)}};
  return json;
}

}  // namespace tactile_net::report
