/// @file
/// Private. A hand with its forces, as SVG text: both axes on one scale.
#pragma once

#include <string>

#include "tactile_net/lab/grasp.hpp"

namespace tactile_net::pages {

/// Links, joints with their numbers, pads, contacts, friction cones, forces, the load, and the
/// hand's axes. Colours are classes for the pages' style.
[[nodiscard]] std::string draw_hand(const lab::GraspResult& grasp);

}  // namespace tactile_net::pages
