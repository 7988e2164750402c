/// @file
/// Integrals of a disc's tractions over polygons. Private.
#pragma once

#include <span>

#include "skin/load_part.hpp"
#include "tactile_net/elasticity/space/disc.hpp"

namespace tactile_net {

/// Of a disc's force on the unit disc, the share on a polygon.
///
/// @param corners  against the clock, (u, v)
[[nodiscard]] double force_share(DiscProfile profile,
                                 std::span<const SurfaceVector> corners) noexcept;

/// The integrals of u f and v f over the polygon, f = 3 / (2 pi) sqrt(1 - s^2) the sphere's
/// traction.
[[nodiscard]] SurfaceVector dome_moment(std::span<const SurfaceVector> corners) noexcept;

}  // namespace tactile_net
