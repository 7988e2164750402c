/// @file
/// A grasp of the plane, or in space, as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "tactile_net/lab/space_grasp.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string grasp_json(const lab::GraspResult& grasp);
[[nodiscard]] std::string grasp_json(const lab::SpaceGraspResult& grasp);

}  // namespace tactile_net::report
