#include "tactile_net/report/json/simulate_json.hpp"

#include "report/json/scene_json.hpp"

namespace tactile_net::report {

std::string simulate_json(const Scene& scene, const lab::RecordedFrames& recorded,
                          std::span<const std::string> columns) {
  Json json = scene_json(kind::simulate, scene);
  json.erase("frame");
  json["frames"] = recorded.frames;
  json["rate"] = scene.time ? Json(scene.time->rate) : Json(nullptr);
  json["columns"] = columns;
  json["frames_cut_off"] = recorded.cut_off;
  return text_of(json);
}

}  // namespace tactile_net::report
