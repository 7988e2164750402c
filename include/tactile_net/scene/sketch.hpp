/// @file
/// A scene for recorded readings, written with comments for a person to go on with.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/skin/curved_surface.hpp"

namespace tactile_net {

/// What is known of a pad and its sensors when somebody begins. Numbers are in the units that the
/// file is to state.
struct SceneSketch {
  std::vector<std::string> remarks{};  ///< where it comes from, a line of comment each
  std::string title{};                 ///< empty: none
  std::string length_unit{}, modulus_unit{}, stress_unit{}, force_unit{};  ///< empty: not stated
  std::string taxels{};  ///< the file of their places, of a curved skin; empty: none
  /// Of a flat skin; 0: a row of `count`.
  std::size_t rows = 0, columns = 0;
  std::size_t count = 0;
  double pitch = 0.0;
  std::vector<double> depths{};
  std::vector<Quantity> reads{};
  double youngs_modulus = 0.0;
  bool youngs_modulus_known = true;       ///< else a comment says that any will do
  std::optional<double> poisson_ratio{};  ///< absent: 0.45, and a comment that says so
  std::optional<Layer> layer{};
  std::vector<double> noise{};  ///< rms: one, or one for each of `reads`; none: not known
  SurfaceFrames frames = SurfaceFrames::tangent;  ///< of a curved skin's [surface]
  /// A ball's contact with the middle of a skin, so that it can be run: its radius and force.
  double contact_radius = 0.0, contact_force = 0.0;
};

/// TOML that `parse_any_scene` takes, if the numbers are in their ranges. The forward model is the
/// exact one. What is not given stands there as a comment, with what it would say.
[[nodiscard]] std::string scene_text(const SceneSketch& sketch);

}  // namespace tactile_net
