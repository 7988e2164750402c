/// @file
/// Taxels of a frame whose readings stand at the end of what the sensor can read: one rule for
/// lines and skins, simulated and recorded.
///
///     const ClippedTaxels clipped = clipped_taxels(scene, layout.readings, readings);
///     if (clipped.range_known) leave_out(clipped.taxels);  // what they read is only a bound
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/scene/sensor_effects.hpp"

namespace tactile_net {

struct ClippedTaxels {
  std::vector<std::size_t> taxels{};  ///< rising; dead ones are none of them
  /// Saturation or converter state the range. Else five taxels of a channel at least hold one
  /// largest value, bit by bit, and more than three times as many as hold the next: noise leaves
  /// none, and a load that mirrors itself as many of the next.
  bool range_known = false;
};

/// An end within a twentieth of the range's larger one is none: without a load noise reaches it.
///
/// @param sites     of every reading
/// @param readings  one for each; NaN: missing, and not clipped
[[nodiscard]] ClippedTaxels clipped_taxels(const SensorEffects& effects,
                                           std::span<const Site> sites,
                                           std::span<const double> readings);

}  // namespace tactile_net
