/// @file
/// How many readings a family's answer uses up. Private.
#pragma once

#include <cmath>
#include <span>

namespace tactile_net {

/// tr H = sum gamma^2 / (gamma^2 + alpha), without a square that overflows.
[[nodiscard]] inline double degrees_of_freedom_of(std::span<const double> gammas,
                                                  double alpha) noexcept {
  double sum = 0.0;
  for (const double gamma : gammas) {
    const double root = gamma / std::hypot(gamma, std::sqrt(alpha));
    sum += root * root;
  }
  return sum;
}

}  // namespace tactile_net
