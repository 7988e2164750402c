/// @file
/// How large readings are where a stress is. Private.
#pragma once

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// About the reading of a quantity where stresses are of this size over this length.
///
/// @param length  [m]
[[nodiscard]] inline double reading_size(Quantity quantity, double stress, double length,
                                         const Material& material) noexcept {
  const double compliance = (1.0 + material.poisson_ratio) / material.youngs_modulus;
  switch (traits(quantity).kind) {
    case QuantityKind::stress:
      return stress;
    case QuantityKind::strain:
      return stress * compliance;
    case QuantityKind::displacement:
      return stress * compliance * length;
  }
  return stress;
}

}  // namespace tactile_net
