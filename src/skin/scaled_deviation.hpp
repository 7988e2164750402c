/// @file
/// The deviation of a sum from its variance, of weights of any size, and of how many cells they
/// are. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/inverse/covariance.hpp"

namespace tactile_net {

/// By weights over the largest one: a weight may be an area, whose square no number holds.
[[nodiscard]] inline double scaled_deviation(const Covariance& covariance,
                                             std::span<const double> weights) {
  double most = 0.0;
  for (const double weight : weights) most = std::max(most, std::abs(weight));
  if (!(most > 0.0)) return 0.0;
  std::vector<double> shares(weights.begin(), weights.end());
  for (double& share : shares) share /= most;
  return most * std::sqrt(std::max(covariance.covariance(shares, shares), 0.0));
}

/// Whether every weight that is not 0 lies in one cell; also where none does.
[[nodiscard]] inline bool is_of_one_cell(std::span<const double> weights,
                                         std::size_t cells) noexcept {
  const auto first =
      std::find_if(weights.begin(), weights.end(), [](double w) { return w != 0.0; });
  const auto cell = static_cast<std::size_t>(first - weights.begin()) % cells;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] != 0.0 && i % cells != cell) return false;
  return true;
}

}  // namespace tactile_net
