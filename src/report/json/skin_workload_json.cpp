#include "tactile_net/report/json/skin_workload_json.hpp"

#include <algorithm>

#include "report/json/computations_json.hpp"
#include "report/json/scene_json.hpp"

namespace tactile_net::report {

std::string workload_json(const SkinScene& scene, const lab::SkinWorkload& work) {
  Json json = scene_json(kind::explain, scene);
  Json effects = Json::array();
  const auto operations = static_cast<double>(reading_count(scene.sensor));
  for (const SceneEffect& effect : scene_effects()) {
    const bool simulated =
        std::find(work.effects.begin(), work.effects.end(), &effect) != work.effects.end();
    effects.push_back(
        {{"effect", effect.name},
         {"simulated", simulated},
         {"operations_per_frame", simulated ? effect.operations(scene) * operations : 0.0},
         {"text", simulated ? effect.words(scene) : std::string(effect.absence)}});
  }
  json["plan"] = {{"effects", effects}, {"computations", computations_json(work.tasks)}};
  return text_of(json);
}

}  // namespace tactile_net::report
