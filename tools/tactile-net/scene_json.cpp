#include "scene_json.hpp"

namespace tactile_net::tool {

Json scene_json(const Scene& scene) {
  Json simulated = Json::array();
  Json absent = Json::array();
  for (const auto& [effect, present] : effects(scene))
    (present ? simulated : absent).push_back(effect);
  Json json = {{"tactile_net", TACTILE_NET_VERSION},
               {"scene", scene.file},
               {"effects", {{"simulated", simulated}, {"absent", absent}}}};
  if (scene.time)
    json["frame"] = {
        {"index", scene.frame}, {"of", scene.time->frames}, {"t", scene.time->time(scene.frame)}};
  return json;
}

}  // namespace tactile_net::tool
