/// @file
/// How every JSON result begins.
#pragma once

#include <nlohmann/json.hpp>

#include "tactile_net/scene/scene.hpp"

namespace tactile_net::tool {

using Json = nlohmann::ordered_json;

/// {"tactile_net": version, "scene": file, "effects": {"simulated": [...], "absent": [...]}}
[[nodiscard]] Json scene_json(const Scene& scene);

}  // namespace tactile_net::tool
