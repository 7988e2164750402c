/// @file
/// Two fingers of two links: the thesis' system of four equations for the torques (6.23).
#pragma once

#include <array>

#include "tactile_net/grasp/finger.hpp"
#include "tactile_net/grasp/finger_action.hpp"

namespace tactile_net {

struct TwoFingerTorques {
  std::array<double, 2> left{};  ///< base first
  std::array<double, 2> right{};
  double condition = 0.0;  ///< condition number of the scaled system
};

/// Solves, in the frame L of the left fingertip, whose origin is the left contact point, with R the
/// right one's, P the palm's, A_rl and b_rl from R to L, e = b_rl / |b_rl|, S(r) = (-r_y, r_x):
///
///     J_l^-T tau_l + A_rl J_r^-T tau_r = -A_pl f_e
///     S(b_rl) A_rl J_r^-T tau_r        = -S(p_B) A_pl f_e - t_e
///     e.J_l^-T tau_l - e.A_rl J_r^-T tau_r = f_g + |e.A_pl f_e|
///
/// with the errata of docs/errata.md. `hold` finds the same torques without a frame of its own, for
/// any hand; this stands for the source, and as its witness.
///
/// @param left_centre, right_centre  y* of the contacts [m]
/// @param grasping_force             f_g
/// @throw std::invalid_argument  a finger does not have two links, is straight, or is wrong (see
///                               `check`); a contact is outside its pad; the contacts coincide; a
///                               number is not finite
[[nodiscard]] TwoFingerTorques two_finger_torques(const Finger& left, double left_centre,
                                                  const Finger& right, double right_centre,
                                                  const ExternalLoad& load, double grasping_force);

}  // namespace tactile_net
