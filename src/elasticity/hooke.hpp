/// @file
/// From the three stresses to any quantity a sensor reads. Private.
#pragma once

#include <limits>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// The three stresses, of type double (kernel) or std::complex<double> (transform).
template <class Number>
struct Stress {
  Number x, y, shear;
};

/// Hooke's law for plane strain: the strain along the axis of `along`.
template <class Number, class Ratio>
Number strain(const Number& along, const Number& across, const Ratio& nu, double modulus) noexcept {
  return (1.0 + nu) * ((1.0 - nu) * along - nu * across) / modulus;
}

/// The reading of a line array; NaN of a quantity that is none of `line_quantities`.
///
/// @tparam Ratio  of nu: double, or a Dual where the answer's slope by it is asked for
template <class Number, class Ratio>
Number read(Quantity quantity, const Stress<Number>& stress, const Ratio& nu,
            double modulus) noexcept {
  switch (quantity) {
    case Quantity::stress_x:
      return stress.x;
    case Quantity::stress_y:
      return stress.y;
    case Quantity::shear_xy:
      return stress.shear;
    case Quantity::strain_x:
      return strain(stress.x, stress.y, nu, modulus);
    case Quantity::strain_y:
      return strain(stress.y, stress.x, nu, modulus);
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

template <class Number>
Number read(Quantity quantity, const Stress<Number>& stress, const Material& material) noexcept {
  return read(quantity, stress, material.poisson_ratio, material.youngs_modulus);
}

}  // namespace tactile_net
