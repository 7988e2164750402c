/// @file
/// The unit of angles, whatever a scene's other units are. Private.
#pragma once

#include <numbers>

#include "tactile_net/scene/units.hpp"

namespace tactile_net {

inline constexpr Unit angle_degrees{"deg", std::numbers::pi, 180.0};

}  // namespace tactile_net
