/// @file
/// How the JSON documents of a scene begin.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "report/json/described.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::report {

/// {"simulated": [...], "absent": [...]}: the effects' names.
[[nodiscard]] Json effects_json(const std::vector<std::pair<std::string_view, bool>>& effects);

/// As `document`, then {"scene": file, "effects": {"simulated": [...],
/// "absent": [...]}}, and "frame" of a scene over time.
[[nodiscard]] Json scene_json(const DocumentKind& kind, const Scene& scene);
[[nodiscard]] Json scene_json(const DocumentKind& kind, const SkinScene& scene);

/// The units of a document's numbers, and those of the scene's file.
struct UnitsTold {
  struct Stated {
    std::string_view length{}, modulus{}, stress{}, force{};

    static constexpr auto described =
        std::tuple{field("length", &Stated::length, "Of lengths."),
                   field("modulus", &Stated::modulus, "Of Young's modulus."),
                   field("stress", &Stated::stress, "Of readings that are stresses."),
                   field("force", &Stated::force, "Of loads.")};
  };
  std::string_view length{}, stress{}, force{};
  Stated stated{};

  static constexpr auto described =
      std::tuple{field("length", &UnitsTold::length, "Of lengths."),
                 field("stress", &UnitsTold::stress, "Of stresses, tractions and moduli."),
                 field("force", &UnitsTold::force, "Of loads."),
                 field("stated", &UnitsTold::stated, "What the scene's file is in.")};
};

/// @param force  Dimension::force of a line, of a skin Dimension::point_force
[[nodiscard]] UnitsTold units_told(const Units& units, Dimension force);
[[nodiscard]] Json units_json(const Units& units);
/// The same, whose force is a point's.
[[nodiscard]] Json skin_units_json(const Units& units);

}  // namespace tactile_net::report
