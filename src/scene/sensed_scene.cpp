// What follows from the table of effects, whatever stands in it.
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net {

SensedScene::SensedScene(const Scene& scene)
    : effects(&scene),
      material(&scene.material),
      units(&scene.units),
      reads(scene.sensor.reads.begin(), scene.sensor.reads.end()),
      taxels(scene.sensor.count),
      drags(any_friction(scene)) {}

SensedScene::SensedScene(const SkinScene& scene)
    : effects(&scene),
      material(&scene.material),
      units(&scene.units),
      reads(scene.sensor.reads.begin(), scene.sensor.reads.end()),
      taxels(taxel_count(scene.sensor)),
      drags(any_drag(scene)) {}

namespace {

std::vector<std::pair<std::string_view, bool>> effects_of(const SensedScene& scene) {
  std::vector<std::pair<std::string_view, bool>> result;
  for (const SceneEffect& effect : scene_effects())
    result.emplace_back(effect.name, effect.present(scene));
  return result;
}

}  // namespace

std::vector<std::pair<std::string_view, bool>> effects(const Scene& scene) {
  return effects_of(scene);
}

std::vector<std::pair<std::string_view, bool>> effects(const SkinScene& scene) {
  return effects_of(scene);
}

SignalPath signal_path(const SensorEffects& effects, const SignalLayout& sensor) {
  std::vector<std::unique_ptr<SensorEffect>> stages;
  for (const SceneEffect& effect : scene_effects())
    if (effect.make != nullptr) stages.push_back(effect.make(effects, sensor));
  return {std::move(stages), sensor.readings.size()};
}

}  // namespace tactile_net
