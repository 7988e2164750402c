/// @file
/// The layer that tests of contacts press on.
#pragma once

#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

inline Material layer(double nu, Base base = Base::bonded) {
  return {.youngs_modulus = 2e5, .poisson_ratio = nu, .layer = Layer{3e-3, base}};
}

}  // namespace tactile_net
