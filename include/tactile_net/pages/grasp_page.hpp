/// @file
/// The page about a grasp.
#pragma once

#include <string>

#include "tactile_net/lab/grasp.hpp"

namespace tactile_net::pages {

/// One self-contained page: the drawing, the tables, what they mean.
[[nodiscard]] std::string grasp_report_html(const lab::GraspResult& grasp);

}  // namespace tactile_net::pages
