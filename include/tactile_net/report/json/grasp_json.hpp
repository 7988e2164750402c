/// @file
/// A grasp as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "tactile_net/lab/grasp.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string grasp_json(const lab::GraspResult& grasp);

}  // namespace tactile_net::report
