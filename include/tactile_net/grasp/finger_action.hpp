/// @file
/// What one finger does in a grasp, and the load it is done against.
#pragma once

#include <vector>

#include "tactile_net/grasp/contact_covariance.hpp"
#include "tactile_net/grasp/vector2.hpp"
#include "tactile_net/inverse/uncertainty.hpp"

namespace tactile_net {

/// What acts on the object besides the fingers, in the palm's frame.
struct ExternalLoad {
  Vector2 force{};      ///< f_e [N, or N/m out of plane: as the fingers' forces]
  double torque = 0.0;  ///< t_e, counter-clockwise
  Vector2 point{};      ///< B, where the force acts [m]
};

/// The force of one finger on the object, and the torques behind it.
struct FingerAction {
  Vector2 point{};                    ///< O: the point of contact, in the palm's frame [m]
  Vector2 force{};                    ///< f: of the finger on the object, in the palm's frame
  double normal = 0.0;                ///< F_v: force into the pad, the reverse of `force`
  double tangential = 0.0;            ///< F_t: force on the pad along the sensor's y
  ContactCovariance<2> covariance{};  ///< covariance of (normal, tangential)
  std::vector<Uncertain> torques{};   ///< J' f: of the joints, base first, counter-clockwise
};

}  // namespace tactile_net
