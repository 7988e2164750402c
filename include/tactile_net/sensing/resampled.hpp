/// @file
/// Tractions on one grid as values on another.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

/// Tractions on `from`, normal and then tangential, at the places of `to`: straight lines between
/// the points, 0 one spacing beyond the outermost ones. The same tractions where the points of
/// `from` are among those of `to`.
[[nodiscard]] std::vector<double> resampled(std::span<const double> tractions, const Surface& from,
                                            const Surface& to);

}  // namespace tactile_net
