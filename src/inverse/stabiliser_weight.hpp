/// @file
/// How much heavier the stabiliser of a tangential traction is. Private.
#pragma once

#include <cstddef>

namespace tactile_net {

/// What L of one traction is multiplied by. @param component  0: the normal one
[[nodiscard]] constexpr double stabiliser_weight(std::size_t component,
                                                 double tangential_weight) noexcept {
  return component == 0 ? 1.0 : tangential_weight;
}

}  // namespace tactile_net
