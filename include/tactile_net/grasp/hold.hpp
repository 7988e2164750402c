/// @file
/// The torques that would hold a load: the general grasp map, for any number of planar fingers.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/grasp/finger.hpp"
#include "tactile_net/grasp/finger_action.hpp"
#include "tactile_net/grasp/fingertip_force.hpp"
#include "tactile_net/grasp/space/hold_in_space.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// A grasp that holds the load. Deviations are those of the contacts' places, propagated as in
/// `MeasuredGrasp`; a force on its cone's edge is taken to stay there.
struct HeldGrasp {
  std::vector<FingerAction> fingers{};
  Matrix torque_covariance{};  ///< covariance of all torques, finger after finger
  double squeeze = 0.0;
  double condition = 0.0;  ///< of the scaled system: its logarithm is the digits lost
};

/// The forces that hold the load, worked out for the same hand in space (`in_space`): the least sum
/// of tau_j^2 over all joints of all fingers, with tau = J' f, among the contact forces f in
/// equilibrium with the load, G f + w_e = 0, and with the squeeze that is asked for. With two
/// fingers and a squeeze nothing is left to minimise: see `two_finger_torques`.
///
/// @throw std::invalid_argument  fewer than two fingers; not as many contacts as fingers, or one is
///                               wrong (see `check`); both options, f_g with three fingers, a
///                               number that is not finite; a straight finger (its name is in the
///                               text); contacts in one point; a squeeze with a contact at the
///                               contacts' middle
/// @throw CannotHoldInSpace      torques do not determine the forces: a part of them costs none; or
///                               no forces within the cones carry the load: its `reason` says which
[[nodiscard]] HeldGrasp hold(std::span<const Finger> fingers,
                             std::span<const ContactPlace> contacts, const ExternalLoad& load,
                             const HoldOptions& options = {});

}  // namespace tactile_net
