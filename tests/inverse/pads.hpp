/// @file
/// The pads of most tests: one in units of its own, one of silicone.
#pragma once

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

inline constexpr Material pad{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
/// 9 taxels two depths apart.
inline const SensorArray coarse_array{
    .count = 9, .pitch = 2.0, .depths = {1.0}, .reads = {Quantity::stress_x}};

/// Rms of the noise on its readings.
inline constexpr double pad_noise = 2e-3;

inline constexpr Material silicone{.youngs_modulus = 2e5, .poisson_ratio = 0.45};

}  // namespace tactile_net
