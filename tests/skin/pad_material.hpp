/// @file
/// The material of the pad in scenes/skins/pad.
#pragma once

#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

inline constexpr Material pad_material{.youngs_modulus = 0.25e6,
                                       .poisson_ratio = 0.48,
                                       .layer = Layer{.thickness = 4e-3, .base = Base::bonded}};

}  // namespace tactile_net
