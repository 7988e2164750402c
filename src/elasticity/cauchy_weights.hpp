/// @file
/// From the Cauchy transform of a load to what a sensor in a half plane reads of it. Private.
///
/// With C(z) the integral of f(s) / (z - s) ds at z = u + i depth, every stress is a real or
/// imaginary part of C and of depth C' (Muskhelishvili).
#pragma once

#include <complex>
#include <numbers>

#include "elasticity/hooke.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

struct CauchyWeights {
  double potential = 0.0;  // of C
  double slope = 0.0;      // of depth C'
  bool odd = false;        // the reading changes sign with u

  /// @param potential_at  C
  /// @param slope_at      C', in units in which the depth is `depth`
  [[nodiscard]] double reading(const std::complex<double>& potential_at,
                               const std::complex<double>& slope_at, double depth) const noexcept {
    const double share = slope * depth;
    return odd ? potential * potential_at.real() + share * slope_at.imag()
               : share * slope_at.real() - potential * potential_at.imag();
  }
};

/// Readings of even parity are made of -Im C and depth Re C', odd ones of Re C and depth Im C', so
/// that Hooke's law cancels in the weights, before any value is rounded.
[[nodiscard]] inline CauchyWeights cauchy_weights(Quantity quantity, Traction component,
                                                  const Material& material) noexcept {
  const bool normal = component == Traction::normal;
  const Stress<double> potential = normal ? Stress<double>{.x = 1.0, .y = 1.0, .shear = 0.0}
                                          : Stress<double>{.x = 0.0, .y = 2.0, .shear = 1.0};
  const Stress<double> slope = normal ? Stress<double>{.x = 1.0, .y = -1.0, .shear = 1.0}
                                      : Stress<double>{.x = 1.0, .y = -1.0, .shear = -1.0};
  return {.potential = read(quantity, potential, material) / std::numbers::pi,
          .slope = read(quantity, slope, material) / std::numbers::pi,
          .odd = is_odd(quantity, component)};
}

}  // namespace tactile_net
