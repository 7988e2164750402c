/// @file
/// The page about a grasp.
#pragma once

#include <string>

#include "grasp_study.hpp"

namespace tactile_net::tool {

/// One self-contained page: the drawing, the tables, what they mean.
[[nodiscard]] std::string grasp_report_html(const GraspStudy& study);

}  // namespace tactile_net::tool
