/// @file
/// The size of a contact from its pressure. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/uncertainty.hpp"

namespace tactile_net {

/// A size that lies anywhere between `least` and its value.
/// @param is_likeliest  the value is: most sizes lie near it
inline Uncertain down_to(const Uncertain& size, double least, bool is_likeliest) {
  const double range = size.value - least;
  if (is_likeliest) return {size.value, std::hypot(size.deviation, range / std::sqrt(3.0))};
  return {size.value - 0.5 * range, std::hypot(size.deviation, range / std::sqrt(12.0))};
}

/// The share of a variance's root that is left without what smoothing added to it.
inline double share_without(double variance, double smoothed) {
  if (!(smoothed > 0.0)) return 1.0;
  return variance > smoothed ? std::sqrt(1.0 - smoothed / variance) : 0.0;
}

/// (sum p)^2 A / sum p^2, and its gradient by each p.
struct Extent {
  double value = 0.0;
  std::vector<double> gradient{};
};

/// @param cell  A: the area or the length that a value stands for
/// @return absent if the sum of p is not > 0
inline std::optional<Extent> extent_of(std::span<const double> p, double cell) {
  double largest = 0.0;
  for (const double value : p) largest = std::max(largest, std::abs(value));
  double sum = 0.0;  // of values over the largest one, which are numbers in any unit
  double squares = 0.0;
  for (const double value : p) {
    const double share = largest > 0.0 ? value / largest : 0.0;
    sum += share;
    squares += share * share;
  }
  if (!(sum > 0.0)) return std::nullopt;
  Extent extent{.value = sum * (sum / squares) * cell, .gradient = {}};
  for (const double value : p)
    extent.gradient.push_back(2.0 * cell * (sum / squares) *
                              (1.0 - value / largest * (sum / squares)) / largest);
  return extent;
}

}  // namespace tactile_net
