/// @file
/// The transforms of rigid indenters' tractions. Private.
#pragma once

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/elasticity/space/disc.hpp"

namespace tactile_net {

struct IndenterTransform {
  double value = 1.0;  ///< integral of the traction times cos(k t), over the force
  double slope = 0.0;  ///< by z = k a
};

/// @param z  k a, >= 0
[[nodiscard]] IndenterTransform indenter_transform(Shape shape, double z);
/// Of what presses on a circle: 2 pi times the integral of r p(r) J0(k r), over the force.
[[nodiscard]] IndenterTransform indenter_transform(DiscProfile profile, double z);

}  // namespace tactile_net
