/// @file
/// What a curved surface is in the sensor's own axes: vectors, places with their frames, and cells
/// that tractions are solved for.
///
/// The axes are any right-handed ones [m]. Each place has a frame of its own, as in
/// elasticity/quantity.hpp: x into the material, against the outward normal.
#pragma once

#include <array>
#include <cmath>

#include "tactile_net/elasticity/space/ball_kernel.hpp"

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

/// a x + b y.
[[nodiscard]] constexpr SpaceVector combined(double a, const SpaceVector& x, double b,
                                             const SpaceVector& y) noexcept {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}

/// A place on a surface.
struct SurfacePlace {
  SpaceVector point{};                ///< [m]
  SurfaceFrame frame{};               ///< x against the outward normal
  double stretch = 1.0;               ///< the surface's area over that of its chart
  double mean_curvature = 0.0;        ///< [1/m]; > 0 where the surface is that of a ball
  double curvature_difference = 0.0;  ///< of the largest and the least curvature there [1/m], >= 0
};

/// A cell, with what tractions that are 1 Pa all over it amount to. Tractions turn with the frames
/// of its places.
struct SurfaceCell {
  SurfacePlace middle{};
  double area = 0.0;                    ///< [m^2]
  SpaceVector first_moment{};           ///< the integral of its places [m^3]
  std::array<SpaceVector, 3> force{};   ///< of 1 Pa along x, y and z of its frames [N]
  std::array<SpaceVector, 3> moment{};  ///< the same about the sensor's origin [N m]
};

}  // namespace tactile_net
