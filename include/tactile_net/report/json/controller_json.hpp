/// @file
/// A controller's plan as JSON: the choice and the candidates, not the matrices.
#pragma once

#include <string>

#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/scene/any_scene.hpp"

namespace tactile_net::report {

/// @param frame_seconds  measured on this machine
[[nodiscard]] std::string controller_json(const AnyScene& scene,
                                          const lab::PlannedController& planned,
                                          double frame_seconds);

}  // namespace tactile_net::report
