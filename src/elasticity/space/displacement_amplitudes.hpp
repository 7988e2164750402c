/// @file
/// The displacements that a wave of unit load causes in a layer, for any k > 0 and any number type:
/// the table of docs/internals/space.md, written once. Private.
#pragma once

#include <cmath>

#include "elasticity/layer_functions.hpp"

namespace tactile_net {

/// Times 2 G, in the order in which the tables have them: under p, under q_L. Without the factors
/// -i that plane_wave.hpp speaks of.
template <class Number>
struct DisplacementsOf {
  Number normal_x, normal_along, tangential_x, tangential_along;
};

/// Times k and Delta.
template <class Number>
DisplacementsOf<Number> bonded_displacements(const Number& nu, const LayerFunctionsOf<Number>& f) {
  const Number kappa = 3.0 - 4.0 * nu;
  const Number m = 1.0 - 2.0 * nu;
  const Number n = 2.0 - 2.0 * nu;
  const Number even = n * kappa * (f.sinh_U - f.sinh_a);
  const Number even_wave = kappa * f.a * f.cosh_U - (kappa * f.H + f.t) * f.cosh_a;
  const Number odd = m * kappa * (f.cosh_U - f.cosh_a);
  const Number odd_wave = kappa * f.a * f.sinh_U - (kappa * f.H - f.t) * f.sinh_a;
  return {0.5 * (even + even_wave) - f.H * f.t * f.sinh_a,
          0.5 * (odd_wave - odd) + f.H * f.t * f.cosh_a,
          0.5 * (odd_wave + odd) - f.H * f.t * f.cosh_a,
          0.5 * (even - even_wave) - f.H * f.t * f.sinh_a};
}

/// Times k and D. The sums and differences of hyperbolic functions are products, or a thin layer's
/// u_x would be a difference of ones.
template <class Number>
DisplacementsOf<Number> frictionless_displacements(const Number& nu,
                                                   const LayerFunctionsOf<Number>& f) {
  using std::exp;
  using std::expm1;
  const Number m = 1.0 - 2.0 * nu;
  const Number n = 2.0 - 2.0 * nu;
  const Number x_wave = f.a * f.sinh_U - (f.H + f.t) * f.sinh_a;
  const Number along_wave = f.a * f.cosh_U + (f.H + f.t) * f.cosh_a;
  const Number cosh_H = 1.0 + exp(-2.0 * f.H);  // times 2 exp(-H), as the next
  const Number sinh_H = -expm1(-2.0 * f.H);
  const Number decay = exp(-f.a);
  const Number cosh_t = decay * (1.0 + exp(-2.0 * f.t));  // times 2 exp(-H), as the next
  const Number sinh_t = -decay * expm1(-2.0 * f.t);
  return {n * sinh_H * sinh_t + 0.5 * x_wave, 0.5 * along_wave - m * sinh_H * cosh_t,
          m * cosh_H * sinh_t + 0.5 * (f.a * f.cosh_U - (f.H + f.t) * f.cosh_a),
          n * cosh_H * cosh_t - 0.5 * (f.a * f.sinh_U + (f.H + f.t) * f.sinh_a)};
}

}  // namespace tactile_net
