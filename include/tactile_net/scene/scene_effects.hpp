/// @file
/// What stands between a scene's words and the effects' files: one table, in the order of the
/// signal path, that the simulation, the workload and the JSON all follow; a line's and a skin's.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/sensor_effects.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net {

/// What the table asks of a scene, which must outlive it.
struct SensedScene {
  SensedScene(const Scene& scene);
  SensedScene(const SkinScene& scene);

  const SensorEffects* effects;
  const Material* material;
  const std::optional<Units>* units;
  std::vector<Quantity> reads;
  std::size_t taxels;
  bool drags;  ///< a contact drags the surface at any time
};

struct SceneEffect {
  std::string_view name;
  bool (*present)(const SensedScene& scene);
  /// The effect's stage; null for what acts before the readings: friction and layer.
  std::unique_ptr<SensorEffect> (*make)(const SensorEffects& effects, const SignalLayout& sensor);
  /// What it does, in this scene.
  std::string (*words)(const SensedScene& scene);
  /// Floating-point operations for one reading at one moment; a random number counts as 20.
  double (*operations)(const SensedScene& scene);
  /// What its absence saves.
  std::string_view absence = "no stage";
};

[[nodiscard]] std::span<const SceneEffect> scene_effects();

/// The effects a scene may name, in the order of the signal path, each with whether it does: as
/// `effects` of a line's scene.
[[nodiscard]] std::vector<std::pair<std::string_view, bool>> effects(const SkinScene& scene);

/// True if a contact drags the surface at any time.
[[nodiscard]] bool any_friction(const Scene& scene);

}  // namespace tactile_net
