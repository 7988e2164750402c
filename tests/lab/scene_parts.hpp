/// @file
/// What scenes and frames of several tests have alike.
#pragma once

#include <limits>
#include <string>

#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

inline const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};

/// What a skin's sensors read.
inline const std::string three_stresses = "\"stress_x\", \"shear_xy\", \"shear_xz\"";

/// Of [reconstruct].
inline const std::string estimated_weight = "tangential_weight = \"evidence\"\n";

inline constexpr double missing_reading = std::numeric_limits<double>::quiet_NaN();

}  // namespace tactile_net
