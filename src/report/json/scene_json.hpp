/// @file
/// How the JSON documents of a scene begin.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "report/json/document.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::report {

/// {"simulated": [...], "absent": [...]}: the effects' names.
[[nodiscard]] Json effects_json(const std::vector<std::pair<std::string_view, bool>>& effects);

/// As `document`, then {"scene": file, "effects": {"simulated": [...],
/// "absent": [...]}}, and "frame" of a scene over time.
[[nodiscard]] Json scene_json(const DocumentKind& kind, const Scene& scene);
[[nodiscard]] Json scene_json(const DocumentKind& kind, const SkinScene& scene);

/// {"length": "m", "stress": "Pa", "force": "N/m", "stated": {"length": "mm",
/// ...}}: those of the JSON, and those of the scene's file. @pre  the scene has
/// units
[[nodiscard]] Json units_json(const Units& units);
/// The same, whose force is a point's.
[[nodiscard]] Json skin_units_json(const Units& units);

}  // namespace tactile_net::report
