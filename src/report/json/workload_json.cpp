#include "tactile_net/report/json/workload_json.hpp"

#include "report/json/computations_json.hpp"
#include "report/json/scene_json.hpp"
#include "tactile_net/report/words/workload_words.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::report {

std::string workload_json(const Scene& scene, const lab::Workload& work) {
  Json json = scene_json(kind::explain, scene);
  Json effects = Json::array();
  for (const lab::Workload::Effect& effect : work.effects)
    effects.push_back({{"effect", effect.row->name},
                       {"simulated", effect.simulated},
                       {"operations_per_frame", effect.operations},
                       {"text", effect_in_words(effect, scene)}});
  json["plan"] = {{"effects", effects}, {"computations", computations_json(work.tasks)}};
  return text_of(json);
}

}  // namespace tactile_net::report
