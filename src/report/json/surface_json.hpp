/// @file
/// What a page draws of a curved skin's surface, and what its frames' JSON shares with it. Private.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "report/json/rounded.hpp"
#include "report/json/values.hpp"
#include "tactile_net/inverse/contact_patch.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net::report {

[[nodiscard]] inline Json unit_json(const ScaledUnit& unit) {
  return {{"label", unit.label}, {"factor", unit.factor}};
}

/// 1 where a scale would be 0, for pictures divide by it.
[[nodiscard]] inline double scale_or_one(double scale) {
  return scale > 0.0 ? rounded(scale, 4) : 1.0;
}

/// The force on a curved skin in a frame.
struct ShownForce {
  const SpaceWrench* space = nullptr;  ///< null: none is known
  std::string words{};
  bool distrusted = false;
};

/// The corners of the surface's cells, row after row, and the places above its taxels, as whole
/// steps along the sensor's axes; of each frame the force on it, with the place of the surface
/// above its centre.
[[nodiscard]] Json surface_json(const CurvedSkin& curved, const SurfaceGrid& grid,
                                const std::optional<Units>& units,
                                std::span<const ShownForce> frames);

}  // namespace tactile_net::report
