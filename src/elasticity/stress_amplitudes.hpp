/// @file
/// The three stresses that a wave of unit load causes, for any k > 0 and any number type: the
/// formulas of layer.hpp and half_plane.hpp, written once. The imaginary amplitudes (odd in y) come
/// without their factor -i. Private.
#pragma once

#include "elasticity/hooke.hpp"
#include "elasticity/layer_functions.hpp"

namespace tactile_net {

/// @param a  k depth
template <class Number>
Stress<Number> half_plane_amplitudes(Traction component, const Number& a) {
  using std::exp;
  const Number decay = exp(-a);
  if (component == Traction::normal) return {(1.0 + a) * decay, (1.0 - a) * decay, a * decay};
  return {a * decay, (2.0 - a) * decay, (1.0 - a) * decay};
}

template <class Number>
Stress<Number> bonded_amplitudes(Traction component, const Number& nu,
                                 const LayerFunctionsOf<Number>& f) {
  const auto& [H, a, t, cosh_U, sinh_U, cosh_a, sinh_a, square] = f;
  const Number kappa = 3.0 - 4.0 * nu;
  const Number m = 1.0 - 2.0 * nu;
  const Number n = 2.0 - 2.0 * nu;
  const Number delta = f.bonded_determinant(nu);
  const Number even = (H * t + 0.5 * (n * n + m * m)) * cosh_a;
  const Number odd = (H * t + n * m) * sinh_a;
  const Number mixed = 0.5 * a * (kappa * cosh_U + cosh_a);
  if (component == Traction::normal)
    return {(0.5 * kappa * (cosh_U + a * sinh_U) + even + 0.5 * (H + t) * sinh_a) / delta,
            (0.5 * kappa * (cosh_U - a * sinh_U) + (0.5 - m * n - H * t) * cosh_a +
             0.5 * (3.0 * H - t) * sinh_a) /
                delta,
            (mixed - odd) / delta};
  return {
      (odd + mixed) / delta,
      (kappa * (sinh_U - 0.5 * a * cosh_U) + 0.5 * (3.0 * H + t) * cosh_a - odd - sinh_a) / delta,
      (0.5 * kappa * (cosh_U - a * sinh_U) + even - 0.5 * (H + t) * sinh_a) / delta};
}

template <class Number>
Stress<Number> frictionless_amplitudes(Traction component, const LayerFunctionsOf<Number>& f) {
  const auto& [H, a, t, cosh_U, sinh_U, cosh_a, sinh_a, square] = f;
  const Number d = f.frictionless_determinant();
  if (component == Traction::normal) {
    const Number mean = sinh_U + sinh_a;
    const Number wave = a * cosh_U + (H + t) * cosh_a;
    return {0.5 * (mean + wave) / d, 0.5 * (mean - wave) / d,
            0.5 * (a * sinh_U - (H + t) * sinh_a) / d};
  }
  const Number wave = a * sinh_U + (H + t) * sinh_a;
  return {0.5 * wave / d, (cosh_U + cosh_a - 0.5 * wave) / d,
          0.5 * (sinh_U - sinh_a - a * cosh_U + (H + t) * cosh_a) / d};
}

}  // namespace tactile_net
