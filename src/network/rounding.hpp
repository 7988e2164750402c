/// @file
/// Entries of a network's matrices that are nothing but rounding. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// Sets entries to 0 that are only rounding: below eps/2 times the largest, or below the accuracy
/// `known_to` of the matrix. Kept, each would become a resistor of absurd value.
inline void drop_rounding(Matrix& matrix, double known_to) {
  double largest = 0.0;
  for (const double value : matrix.values) largest = std::max(largest, std::abs(value));
  const double floor = std::max(0.5 * std::numeric_limits<double>::epsilon() * largest, known_to);
  for (double& value : matrix.values)
    if (std::abs(value) <= floor) value = 0.0;
}

}  // namespace tactile_net
