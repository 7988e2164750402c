/// @file
/// Places and directions in three dimensions.
#pragma once

#include <array>
#include <cmath>

namespace tactile_net {

/// A place or a direction in the sensor's axes.
using SpaceVector = std::array<double, 3>;

/// The sum of products of components.
[[nodiscard]] constexpr double dot(const SpaceVector& a, const SpaceVector& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[nodiscard]] constexpr SpaceVector cross(const SpaceVector& a, const SpaceVector& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

[[nodiscard]] inline double length(const SpaceVector& one) noexcept {
  return std::hypot(one[0], one[1], one[2]);
}

[[nodiscard]] constexpr SpaceVector multiple(double factor, const SpaceVector& one) noexcept {
  return {factor * one[0], factor * one[1], factor * one[2]};
}

/// a x + b y.
[[nodiscard]] constexpr SpaceVector combined(double a, const SpaceVector& x, double b,
                                             const SpaceVector& y) noexcept {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}

}  // namespace tactile_net
