/// @file
/// Circuits' data sheets give hertz, their equations take radians a second. Private.
#pragma once

#include <numbers>

namespace tactile_net {

/// @return  [rad/s]
[[nodiscard]] constexpr double angular_frequency(double hertz) noexcept {
  return 2.0 * std::numbers::pi * hertz;
}

}  // namespace tactile_net
