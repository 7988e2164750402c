/// @file
/// Whether one draw of a network's resistors settles. Private.
#pragma once

#include "tactile_net/network/reduction.hpp"

namespace tactile_net {

/// As `try_out` says, of equations that the reduction assembled.
[[nodiscard]] bool is_stable(const Reduction& reduction, const Equations& equations);

}  // namespace tactile_net
