/// @file
/// What changes in time, by its values at some moments.
#pragma once

#include <vector>

namespace tactile_net {

/// Straight lines between knots; before the first and after the last, their values.
struct PiecewiseLinear {
  std::vector<double> times{};   ///< [s], rising; at least one
  std::vector<double> values{};  ///< one per time

  [[nodiscard]] double operator()(double t) const noexcept;
};

}  // namespace tactile_net
