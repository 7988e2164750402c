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

}  // namespace tactile_net
