#include "report/json/scene_json.hpp"

#include "tactile_net/numeric/version.hpp"

namespace tactile_net::report {

Json scene_json(const Scene& scene) {
  Json simulated = Json::array();
  Json absent = Json::array();
  for (const auto& [effect, present] : effects(scene))
    (present ? simulated : absent).push_back(effect);
  Json json = {{"tactile_net", version()},
               {"scene", scene.file},
               {"effects", {{"simulated", simulated}, {"absent", absent}}}};
  if (scene.time)
    json["frame"] = {
        {"index", scene.frame}, {"of", scene.time->frames}, {"t", scene.time->time(scene.frame)}};
  return json;
}

}  // namespace tactile_net::report
