/// @file
/// The largest magnitude.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace tactile_net {

inline double largest(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace tactile_net
