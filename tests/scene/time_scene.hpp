/// @file
/// A scene over time, to which tables of effects are added.
#pragma once

#include <string>

#include "tactile_net/scene/reader.hpp"

inline const std::string time_scene = R"([sensor]
count = 5
pitch = 0.5
depth = 1.5
reads = ["strain_x", "strain_y"]

[material]
youngs_modulus = 1.0
poisson_ratio = 0.45

[time]
rate = 10.0
frames = 21

)";

inline tactile_net::Scene scene_with(const std::string& tables) {
  return tactile_net::parse_scene(time_scene + tables, "scene.toml");
}
