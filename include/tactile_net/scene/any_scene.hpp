/// @file
/// A scene of either sensor.
#pragma once

#include <variant>

#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net {

/// A line array or a skin.
using AnyScene = std::variant<Scene, SkinScene>;

}  // namespace tactile_net
