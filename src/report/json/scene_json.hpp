/// @file
/// How the JSON documents of a scene begin.
#pragma once

#include "report/json/document.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::report {

/// As `document`, then {"scene": file, "effects": {"simulated": [...], "absent": [...]}}, and
/// "frame" of a scene over time.
[[nodiscard]] Json scene_json(const DocumentKind& kind, const Scene& scene);

}  // namespace tactile_net::report
