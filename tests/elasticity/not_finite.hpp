/// @file
/// Numbers that no material and no contact may be described with.
#pragma once

#include <limits>

namespace tactile_net {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace tactile_net
