/// @file
/// A grasp in space as JSON; the format is kind `space_grasp`.
#pragma once

#include <string>

#include "tactile_net/lab/space_grasp.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string grasp_json(const lab::SpaceGraspResult& grasp);

}  // namespace tactile_net::report
