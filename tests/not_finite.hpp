/// @file
/// Numbers that no reading, no material and no field of a plan may be.
#pragma once

#include <limits>

namespace tactile_net {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace tactile_net
