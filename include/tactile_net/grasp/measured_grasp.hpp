/// @file
/// What measured fingertip forces mean: the torques at the joints, and how well they carry the
/// load.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/grasp/finger.hpp"
#include "tactile_net/grasp/finger_action.hpp"
#include "tactile_net/grasp/fingertip_force.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// What measured forces mean, worked out for the same hand in space (`in_space`). Deviations are
/// first-order propagation of the fingertips' covariances, by exact derivatives; the fingertips'
/// errors are independent of each other, geometry and load are certain.
struct MeasuredGrasp {
  std::vector<FingerAction> fingers{};
  Matrix torque_covariance{};  ///< covariance of all torques, finger after finger
  /// Sum of all forces on the object along X and Y, and of the moments about the load's point:
  /// zero in equilibrium.
  std::array<Uncertain, 3> unbalanced{};
  /// unbalanced' C^-1 unbalanced, 3 degrees of freedom; absent if C has no inverse.
  std::optional<double> chi_squared{};
  /// |sum of forces| / sum of |forces|, the load among them; 0 without any force.
  double unbalanced_share = 0.0;
  /// Sum of the forces' components towards the middle (mean) of the contact points; two fingers or
  /// more, at different points.
  std::optional<Uncertain> squeeze{};
  std::optional<Uncertain> grasping_force{};  ///< f_g = squeeze - |e.f_e| (thesis 6.9): two fingers
};

/// tau = J' f for every finger (thesis 6.6), with any number of fingers and joints; straight
/// fingers too, whose torques say nothing of the force along them.
///
/// @throw std::invalid_argument  no finger, not as many forces as fingers, or one of them is wrong:
///                               see `check`
[[nodiscard]] MeasuredGrasp measured_grasp(std::span<const Finger> fingers,
                                           std::span<const FingertipForce> forces,
                                           const ExternalLoad& load = {});

/// What 99 % of balanced grasps stay below, if errors are as stated: the quantile of chi squared
/// with 3 degrees of freedom.
inline constexpr double balanced_limit = 11.344866730144373;

}  // namespace tactile_net
