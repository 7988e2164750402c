/// @file
/// The transforms of what presses on a circle. Private.
#pragma once

#include "calibration/indenter_transform.hpp"
#include "tactile_net/elasticity/space/disc.hpp"

namespace tactile_net {

/// 2 pi times the integral of r p(r) J0(k r), over the force.
///
/// @param z  k a, >= 0
[[nodiscard]] IndenterTransform disc_transform(DiscProfile profile, double z);

}  // namespace tactile_net
