/// @file
/// Euclidean lengths that neither overflow nor underflow.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace tactile_net {

inline double norm(std::span<const double> values) {
  double size = 0.0;
  for (const double value : values) size = std::hypot(size, value);
  return size;
}

inline double distance(std::span<const double> a, std::span<const double> b) {
  double size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) size = std::hypot(size, a[i] - b[i]);
  return size;
}

}  // namespace tactile_net
