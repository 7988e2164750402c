/// @file
/// What the forces that skins feel mean for a hand in space: the torques at its joints, and how
/// well they carry the load.
///
///     const std::vector<SpaceFingertipForce> forces = ...;  // by space_fingertip_force
///     const MeasuredSpaceGrasp grasp = measured_grasp(fingers, forces, load);
///     grasp.fingers[0].torques[1];  // of the second joint, with its deviation
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/grasp/space/space_action.hpp"
#include "tactile_net/grasp/space/space_contact.hpp"
#include "tactile_net/grasp/space/space_finger.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// What measured forces mean for a hand in space. Deviations are of first order, by exact
/// derivatives; fingertips err independently, geometry and load are certain.
struct MeasuredSpaceGrasp {
  std::vector<SpaceAction> fingers{};
  Matrix torque_covariance{};  ///< covariance of all torques, finger after finger
  /// Sum of all forces on the object along X, Y, Z, and of all moments about the load's point.
  std::array<Uncertain, 6> unbalanced{};
  Matrix unbalanced_covariance{};
  /// unbalanced' C^-1 unbalanced, 6 degrees of freedom; absent if C has no inverse.
  std::optional<double> chi_squared{};
  /// |sum of forces| / sum of |forces|, the load among them; 0 without any force.
  double unbalanced_share = 0.0;
  /// Sum of the forces' components towards the middle of the contacts, where there is one.
  std::optional<Uncertain> squeeze{};
  std::optional<Uncertain> grasping_force{};  ///< f_g = squeeze - |e.f_e| (thesis 6.9): two fingers
};

/// tau = J' (f, m) for every finger; none where its joints are not known.
///
/// @throw std::invalid_argument  no finger, not as many forces as fingers, or one of them is wrong:
///                               see `check`
[[nodiscard]] MeasuredSpaceGrasp measured_grasp(std::span<const SpaceFinger> fingers,
                                                std::span<const SpaceFingertipForce> forces,
                                                const SpaceLoad& load = {});

/// What 99 % of balanced grasps stay below: the quantile of chi squared with 6 degrees of freedom.
inline constexpr double balanced_space_limit = 16.811893829770927;

}  // namespace tactile_net
