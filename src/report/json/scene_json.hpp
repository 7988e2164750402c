/// @file
/// How every JSON result begins.
#pragma once

#include "report/json/values.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::report {

/// {"tactile_net": version, "scene": file, "effects": {"simulated": [...], "absent": [...]}}
[[nodiscard]] Json scene_json(const Scene& scene);

/// {"length": "m", "stress": "Pa", "force": "N/m", "stated": {"length": "mm", ...}}: those of the
/// JSON, and those of the scene's file. @pre  the scene has units
[[nodiscard]] Json units_json(const Units& units);

}  // namespace tactile_net::report
