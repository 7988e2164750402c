/// @file
/// Which of the rows without load had a load. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "numeric/robust.hpp"

namespace tactile_net::frames {

/// Of each row the rms of its readings about the medians of all rows, over a spread that a few
/// loaded ones do not move.
///
/// @param dead  of each reading, true: it does not count
[[nodiscard]] inline std::vector<double> rest_deviations(
    const std::vector<std::vector<double>>& rows, const std::vector<bool>& dead) {
  const std::size_t n = dead.size();
  std::vector<double> middles(n);
  std::vector<double> spreads(n);
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const std::vector<double>& row : rows) values.push_back(row[j]);
    middles[j] = median(values);
    for (double& value : values) value -= middles[j];
    spreads[j] = robust_rms(std::move(values));
  }
  std::vector<double> result;
  result.reserve(rows.size());
  for (const std::vector<double>& row : rows) {
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      if (!(spreads[j] > 0.0) || dead[j]) continue;
      squares += std::pow((row[j] - middles[j]) / spreads[j], 2);
      count += 1.0;
    }
    result.push_back(std::sqrt(squares / std::max(count, 1.0)));
  }
  return result;
}

}  // namespace tactile_net::frames
