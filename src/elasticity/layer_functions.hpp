/// @file
/// What every amplitude of a layer is made of. Private.
#pragma once

#include <cmath>

namespace tactile_net {

/// The hyperbolic functions of layer.hpp, each times 4 exp(-2 H): nothing overflows.
///
/// @tparam Number  double, or a Dual (numeric/dual.hpp) by thickness and depth
template <class Number>
struct LayerFunctionsOf {
  LayerFunctionsOf(const Number& thickness, const Number& depth, double wavenumber)
      : H(wavenumber * thickness), a(wavenumber * depth), t(wavenumber * (thickness - depth)) {
    using std::exp;
    using std::expm1;
    const Number near = 2.0 * exp(-a);          // of exp(U)
    const Number far = 2.0 * exp(a - 2.0 * H);  // of exp(a)
    cosh_U = near * (1.0 + exp(-2.0 * (H + t)));
    sinh_U = -near * expm1(-2.0 * (H + t));
    cosh_a = far * (1.0 + exp(-2.0 * a));
    sinh_a = -far * expm1(-2.0 * a);
    square = 4.0 * exp(-2.0 * H);
  }

  /// Delta of layer.hpp, times 4 exp(-2 H) too.
  [[nodiscard]] Number bonded_determinant(const Number& nu) const {
    using std::exp;
    const Number m = 1.0 - 2.0 * nu;
    const Number cosh_H = 1.0 + exp(-2.0 * H);
    return (3.0 - 4.0 * nu) * cosh_H * cosh_H + (H * H + m * m) * square;
  }
  /// D.
  [[nodiscard]] Number frictionless_determinant() const {
    using std::expm1;
    return -expm1(-4.0 * H) + H * square;
  }

  Number H, a, t;
  Number cosh_U, sinh_U, cosh_a, sinh_a;
  Number square;  // of 1
};

using LayerFunctions = LayerFunctionsOf<double>;

}  // namespace tactile_net
