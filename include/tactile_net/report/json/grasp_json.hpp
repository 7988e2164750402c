/// @file
/// A grasp's study as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "tactile_net/lab/grasp.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string grasp_json(const lab::GraspStudy& study);

}  // namespace tactile_net::report
