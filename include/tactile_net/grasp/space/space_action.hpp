/// @file
/// What one finger does in a grasp in space, the load that it is done against, and how far that is
/// from slipping.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tactile_net/grasp/margins.hpp"
#include "tactile_net/grasp/space/vector3.hpp"
#include "tactile_net/inverse/uncertainty.hpp"

namespace tactile_net {

/// What acts on the object besides the fingers, in the hand's frame.
struct SpaceLoad {
  Vector3 force{};   ///< [N]
  Vector3 torque{};  ///< [N m]
  Vector3 point{};   ///< where the force acts [m]
};

[[nodiscard]] inline bool is_finite(const SpaceLoad& load) noexcept {
  return is_finite(load.force) && is_finite(load.torque) && is_finite(load.point);
}

/// The force of one finger on the object in space, and the torques behind it.
struct SpaceAction {
  Vector3 point{};   ///< point of contact, in the hand's frame [m]
  Vector3 force{};   ///< force of the finger on the object [N]
  Vector3 moment{};  ///< moment of the finger on the object about `point`, along the normal [N m]
  // The force and the moment as the pad feels them, reversed.
  double normal = 0.0;                  ///< into the pad [N]
  double tangential_y = 0.0;            ///< along the pad's y [N]
  double tangential_z = 0.0;            ///< along the pad's z [N]
  double torsion = 0.0;                 ///< about the pad's x [N m]
  std::array<double, 16> covariance{};  ///< covariance of these four in this order, row-major
  /// As `SpaceContactPlace::torsion_radius` [m]; absent: a hard finger.
  std::optional<double> torsion_radius{};
  std::vector<Uncertain> torques{};  ///< torques of the joints, from the palm

  /// |(F_y, F_z)| [N].
  [[nodiscard]] double tangential() const noexcept {
    return std::hypot(tangential_y, tangential_z);
  }
  /// What counts against friction, torsion T included: |(F_y, F_z, T / radius)| [N].
  [[nodiscard]] double slipping() const noexcept {
    return std::hypot(tangential(), torsion_radius ? torsion / *torsion_radius : 0.0);
  }
  /// Standard deviation of a value, an index into (normal, tangential_y, tangential_z, torsion).
  [[nodiscard]] double deviation(std::size_t value) const noexcept {
    return std::sqrt(std::fmax(covariance[5 * value], 0.0));
  }
};

[[nodiscard]] inline bool is_idle(const SpaceAction& action) noexcept {
  return action.normal == 0.0 && action.slipping() == 0.0;
}

/// How far a force in space is from slipping: for a hard finger from Coulomb's cone, for a soft one
/// from (F_t / (mu F_x))^2 + (T / (mu F_x radius))^2 <= 1 (Howe and Cutkosky 1996), which is a cone
/// too. Where nothing drags, the deviation is an upper bound: any direction may be the nearest
/// edge.
///
/// @param friction  mu, > 0
[[nodiscard]] FrictionMargin friction_margin(const SpaceAction& action, double friction);

}  // namespace tactile_net
