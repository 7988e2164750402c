/// @file
/// The page of a grasp in space: the hand from three sides, forces, torques, what is internal.
#pragma once

#include <string>

#include "tactile_net/lab/space_grasp.hpp"
#include "tactile_net/pages/made.hpp"

namespace tactile_net::pages {

/// One self-contained HTML page.
[[nodiscard]] std::string grasp_report_html(const lab::SpaceGraspResult& grasp, const Made& made);

}  // namespace tactile_net::pages
