/// @file
/// Layers that tests of pads and of skins share.
#pragma once

#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

inline Material layer(double nu, double thickness, Base base) {
  return {.youngs_modulus = 2.0, .poisson_ratio = nu, .layer = Layer{thickness, base}};
}

}  // namespace tactile_net
