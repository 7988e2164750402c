/// @file
/// What bounds of the error have in common. Private.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

namespace tactile_net {

/// What numbers near the smallest double lose to it: the 2-norm of `count` roundings to a multiple
/// of it, over `size`.
[[nodiscard]] inline double underflow_error(std::size_t count, double size) noexcept {
  return std::numeric_limits<double>::denorm_min() / size * std::sqrt(static_cast<double>(count));
}

/// The relative 2-norm error of three transforms of `size` values: readings, kernel, tractions.
[[nodiscard]] inline double transforms_error(std::size_t size) noexcept {
  return 3.0 * std::log2(static_cast<double>(size) + 2.0) * std::numeric_limits<double>::epsilon();
}

}  // namespace tactile_net
