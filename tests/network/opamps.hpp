/// @file
/// The op-amp of most tests of networks.
#pragma once

#include <numbers>

#include "tactile_net/network/opamp.hpp"

namespace tactile_net {

inline constexpr double bandwidth = 1e7;  ///< [Hz]
inline constexpr double angular_bandwidth = 2.0 * std::numbers::pi * bandwidth;
inline constexpr OpAmp one_pole{.gain = 1e6, .bandwidth = bandwidth};

}  // namespace tactile_net
