/// @file
/// What every amplitude of a layer is made of. Private.
#pragma once

#include <cmath>

namespace tactile_net {

/// The hyperbolic functions of layer.hpp, each times 4 exp(-2 H): nothing overflows.
struct LayerFunctions {
  LayerFunctions(double thickness, double depth, double wavenumber)
      : H(wavenumber * thickness), a(wavenumber * depth), t(wavenumber * (thickness - depth)) {
    const double near = 2.0 * std::exp(-a);          // of exp(U)
    const double far = 2.0 * std::exp(a - 2.0 * H);  // of exp(a)
    cosh_U = near * (1.0 + std::exp(-2.0 * (H + t)));
    sinh_U = -near * std::expm1(-2.0 * (H + t));
    cosh_a = far * (1.0 + std::exp(-2.0 * a));
    sinh_a = -far * std::expm1(-2.0 * a);
    square = 4.0 * std::exp(-2.0 * H);
  }

  /// Delta of layer.hpp, times 4 exp(-2 H) too.
  [[nodiscard]] double bonded_determinant(double nu) const {
    const double m = 1.0 - 2.0 * nu;
    const double cosh_H = 1.0 + std::exp(-2.0 * H);
    return (3.0 - 4.0 * nu) * cosh_H * cosh_H + (H * H + m * m) * square;
  }
  /// D.
  [[nodiscard]] double frictionless_determinant() const {
    return -std::expm1(-4.0 * H) + H * square;
  }

  double H, a, t;
  double cosh_U, sinh_U, cosh_a, sinh_a;
  double square;  // of 1
};

}  // namespace tactile_net
