/// @file
/// Readings that depend on where the load came from, not on how fast it came.
#pragma once

#include <memory>
#include <vector>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// The Prandtl-Ishlinskii model (Visintin 1994, III.2; Krejci 1996): a weighted sum of play
/// operators,
///
///     out = in + sum_i weight_i (P_i - in),   P_i(t) = max(in - r_i, min(in + r_i, P_i(t-)))
///
/// each of which stands still within its threshold r_i and follows beyond it. Loops are closed,
/// rate independent and congruent; a new sensor's P_i are 0. Thresholds of 0 are no hysteresis.
struct Hysteresis {
  PerQuantity<std::vector<double>> thresholds;  ///< r_i [unit of the reading], >= 0
  std::vector<double> weights{};                ///< > 0, one per threshold, together <= 1
};

[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const Hysteresis& hysteresis,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
