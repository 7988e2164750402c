/// @file
/// The check of every frame. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace tactile_net {

[[nodiscard]] inline bool all_finite(std::span<const double> values) noexcept {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

}  // namespace tactile_net
