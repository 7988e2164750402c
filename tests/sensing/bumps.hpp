/// @file
/// Piecewise linear tractions to read exactly.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "tactile_net/sensing/exact.hpp"

namespace tactile_net {

inline const SampledTractions bumps{.first = -1.2,
                                    .pitch = 0.4,
                                    .normal = {1.0, 3.0, 0.0, 0.0, 0.0, 2.0},
                                    .tangential = {0.0, -1.0, 0.5, 0.0, 0.0, 0.0}};

inline double peak(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace tactile_net
