/// @file
/// The deviation of a sum from its variance, of weights of any size. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "tactile_net/inverse/uncertainty.hpp"

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

}  // namespace tactile_net
