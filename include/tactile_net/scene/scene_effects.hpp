/// @file
/// What stands between a scene's words and the effects' files: one table, in the order of the
/// signal path, that the simulation, the workload and the JSON all follow.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "tactile_net/scene/scene.hpp"

namespace tactile_net {

struct SceneEffect {
  std::string_view name;
  bool (*present)(const Scene& scene);
  /// The effect's stage; null for what acts before the readings: friction and layer.
  std::unique_ptr<SensorEffect> (*make)(const Scene& scene);
  /// What it does, in this scene.
  std::string (*words)(const Scene& scene);
  /// Floating-point operations for one reading at one moment; a random number counts as 20.
  double (*operations)(const Scene& scene);
  /// What its absence saves.
  std::string_view absence = "no stage";
};

[[nodiscard]] std::span<const SceneEffect> scene_effects();

/// True if a contact drags the surface at any time.
[[nodiscard]] bool any_friction(const Scene& scene);

}  // namespace tactile_net
