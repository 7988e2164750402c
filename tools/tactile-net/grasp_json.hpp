/// @file
/// A grasp's study as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "grasp_study.hpp"

namespace tactile_net::tool {

[[nodiscard]] std::string grasp_json(const GraspStudy& study);

}  // namespace tactile_net::tool
