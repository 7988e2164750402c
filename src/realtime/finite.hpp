/// @file
/// Numbers told from NaN and infinity. Private.
///
/// Where a compiler is told that there are none, it takes every such question out, and frames and
/// plans that are broken would be computed with. The target sets its own options after those of the
/// build (CMakeLists.txt); who compiles the sources by other means is stopped here.
#pragma once

#include <cmath>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error "tactile_net::rt refuses NaN: compile it without -ffast-math, -Ofast and -ffinite-math-only"
#endif

namespace tactile_net {

/// Whether no finite reading, less this one, overflows a double: whoever traps that exception does
/// not want it from a frame that is about to be refused.
[[nodiscard]] inline bool is_baseline(double value) noexcept {
  constexpr double most = 0x1p969;  // a quarter of the last digit of the largest number
  return std::isfinite(value) && std::abs(value) <= most;
}

}  // namespace tactile_net
