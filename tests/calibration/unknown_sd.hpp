/// @file
/// The standard deviation of what nobody knows.
#pragma once

#include <limits>

namespace tactile_net {

inline constexpr double unknown_sd = std::numeric_limits<double>::infinity();

}  // namespace tactile_net
