#include "tactile_net/report/json/skin_workload_json.hpp"

#include <algorithm>

#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/skin_workload_words.hpp"

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
  Json computations = Json::array();
  for (const lab::SkinWorkload::Task& task : work.tasks)
    computations.push_back({{"computation", name(task.what)},
                            {"done", task.done},
                            {"why", why_in_words(task)},
                            {"cost", task.cost ? Json(cost_in_words(task)) : Json(nullptr)}});
  json["plan"] = {{"effects", effects}, {"computations", computations}};
  return text_of(json);
}

}  // namespace tactile_net::report
