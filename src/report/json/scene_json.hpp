/// @file
/// How every JSON result begins.
#pragma once

#include "report/json/values.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::report {

/// {"tactile_net": version, "scene": file, "effects": {"simulated": [...], "absent": [...]}}
[[nodiscard]] Json scene_json(const Scene& scene);

}  // namespace tactile_net::report
