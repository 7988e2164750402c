/// @file
/// Middles and spreads that a few wild values do not move. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tactile_net {

/// The `at`-quantile (nearest rank) of the values, at from 0 to 1; 0 without values.
[[nodiscard]] inline double quantile(std::vector<double> values, double at) {
  if (values.empty()) return 0.0;
  const auto place = values.begin() + std::lround(at * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

[[nodiscard]] inline double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

/// The standard deviation of values about zero, if most are Gaussian: by the median of their
/// sizes; where that is zero, as of coarsely quantised values, by all but the largest tenth.
[[nodiscard]] inline double robust_rms(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  const double middle = median(values);
  if (middle > 0.0 || values.empty()) return 1.4826 * middle;
  std::sort(values.begin(), values.end());
  values.resize(std::max<std::size_t>(values.size() * 9 / 10, 1));
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

}  // namespace tactile_net
