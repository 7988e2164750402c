/// @file
/// What the skin of a fingertip says of its contact: three forces, their centre, and torsion.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "tactile_net/grasp/space/space_finger.hpp"

namespace tactile_net {

/// The numbers of a contact in the order of their covariance, as a skin's resultant has them.
enum class SpaceContactValue { normal, tangential_y, tangential_z, centre_y, centre_z, torsion };

/// Where a contact is, without its force.
struct SpaceContactPlace {
  double y = 0.0;                      ///< centre of pressure [m]
  double z = 0.0;                      ///< [m]
  std::array<double, 4> covariance{};  ///< covariance of (y, z), row-major
  /// The torsion that a soft finger bears without any drag, over mu times the normal force: > 0
  /// [m]; sum p r dA / sum p dA of the pressure p at the distance r from its centre. Absent: a hard
  /// finger, which bears none.
  std::optional<double> torsion_radius{};
  /// True if it bears no force along z: a contact of a hand in the plane of x and y, see
  /// `in_space`.
  bool planar = false;
};

/// The object's force on the pad: (F_x, F_y, F_z), where it acts, and torsion about x through there
/// from y towards z.
struct SpaceFingertipForce {
  double normal = 0.0;                  ///< F_x, into the pad [N]; must be > 0
  double tangential_y = 0.0;            ///< [N]
  double tangential_z = 0.0;            ///< [N]
  double torsion = 0.0;                 ///< [N m]; 0 of a hard finger
  SpaceContactPlace place{};            ///< its covariance is in `covariance`, with the forces'
  std::array<double, 36> covariance{};  ///< in the order of `SpaceContactValue`, row-major

  [[nodiscard]] double covariance_of(SpaceContactValue a, SpaceContactValue b) const noexcept {
    return covariance[6 * static_cast<std::size_t>(a) + static_cast<std::size_t>(b)];
  }
  [[nodiscard]] double deviation(SpaceContactValue value) const noexcept;
};

/// Where a force acts, without the force.
[[nodiscard]] SpaceContactPlace place_of(const SpaceFingertipForce& force) noexcept;

/// @throw std::invalid_argument  a number is not finite, a variance is not >= 0, the radius is not
///                               > 0; of a force, F_x <= 0, a hard finger with torsion, a planar
///                               contact with F_z; the text names the finger
void check(const SpaceFinger& finger, const SpaceContactPlace& place);
void check(const SpaceFinger& finger, const SpaceFingertipForce& force);

}  // namespace tactile_net
