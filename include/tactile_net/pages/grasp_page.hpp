/// @file
/// The page about a grasp.
#pragma once

#include <string>

#include "tactile_net/lab/grasp.hpp"
#include "tactile_net/pages/made.hpp"

namespace tactile_net::pages {

/// One self-contained page: the drawing, the tables, what they mean.
[[nodiscard]] std::string grasp_report_html(const lab::GraspResult& grasp, const Made& made = {});

}  // namespace tactile_net::pages
