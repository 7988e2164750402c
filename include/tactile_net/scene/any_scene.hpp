/// @file
/// A scene of either sensor.
#pragma once

#include <cstddef>
#include <string>
#include <variant>

#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net {

/// A line array or a skin.
using AnyScene = std::variant<Scene, SkinScene>;

/// @pre  the sensor has that taxel
[[nodiscard]] inline std::string taxel_name(const AnyScene& scene, std::size_t taxel) {
  return std::visit([&](const auto& one) { return taxel_name(one.sensor, taxel); }, scene);
}

}  // namespace tactile_net
