/// @file
/// A hand with its forces, as SVG text: both axes on one scale.
#pragma once

#include <string>

#include "tactile_net/lab/grasp.hpp"

namespace tactile_net::pages {

/// Links, joints, pads, contacts, friction cones, forces and the load. Colours are the classes of
/// `drawing_style`.
[[nodiscard]] std::string draw_hand(const lab::GraspResult& grasp);

/// CSS for the drawing and the words that explain it, for light and dark.
[[nodiscard]] std::string drawing_style();

}  // namespace tactile_net::pages
