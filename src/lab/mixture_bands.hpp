/// @file
/// Bands of tractions of which all that the readings leave possible is known. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/numeric/distribution.hpp"

namespace tactile_net::lab {

struct TractionBands {
  std::vector<double> deviations{}, low{}, high{};  // of each [Pa]
};

/// Tractions under constraints.
struct BoundTractions {
  std::span<const double> values{};
  std::size_t pressures = 0;  // that many come first, and may not pull
};

/// @param bound  deviations are about these, and no interval of a pressure reaches below 0; null:
///               about the means
[[nodiscard]] inline TractionBands bands_of(std::span<const Distribution> each, double level,
                                            const BoundTractions* bound) {
  TractionBands bands;
  for (std::size_t i = 0; i < each.size(); ++i) {
    const Distribution& one = each[i];
    const double apart = bound != nullptr ? one.mean() - bound->values[i] : 0.0;
    bands.deviations.push_back(std::hypot(one.deviation(), apart));
    const CentralInterval interval = one.interval(level);
    const bool pushes = bound != nullptr && i < bound->pressures;
    bands.low.push_back(pushes ? std::max(interval.low, 0.0) : interval.low);
    bands.high.push_back(pushes ? std::max(interval.high, 0.0) : interval.high);
  }
  return bands;
}

}  // namespace tactile_net::lab
