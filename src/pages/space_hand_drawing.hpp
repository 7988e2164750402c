/// @file
/// A hand in space as engineers draw it: from the front, from the side and from above. Private.
#pragma once

#include <string>

#include "tactile_net/lab/space_grasp.hpp"

namespace tactile_net::pages {

/// Three <svg> side by side, to one scale.
[[nodiscard]] std::string draw_hand(const lab::SpaceGraspResult& grasp);

}  // namespace tactile_net::pages
