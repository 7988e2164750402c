/// @file
/// A recording of a scene's sensor as JSON.
#pragma once

#include <span>
#include <string>

#include "tactile_net/lab/summary.hpp"
#include "tactile_net/scene/any_scene.hpp"

namespace tactile_net::report {

/// @param columns  of the file of readings
[[nodiscard]] std::string simulate_json(const AnyScene& scene, const lab::RecordedFrames& recorded,
                                        std::span<const std::string> columns);

}  // namespace tactile_net::report
