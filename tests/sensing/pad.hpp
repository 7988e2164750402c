/// @file
/// The material of most tests of readings.
#pragma once

#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

inline constexpr Material pad{.youngs_modulus = 2.0, .poisson_ratio = 0.45};

}  // namespace tactile_net
