/// @file
/// Which contact forces carry a load and which only press the fingers against each other: the
/// grasp matrix G and what it takes to zero.
///
/// Contacts have three forces (hard) or three and a torsion (soft); G takes them to the force and
/// the moment on the object, six numbers. What lies in its null space is internal.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/grasp/space/space_action.hpp"
#include "tactile_net/grasp/space/space_contact.hpp"
#include "tactile_net/grasp/space/space_finger.hpp"

namespace tactile_net {

/// How an object may move: a screw.
struct ObjectMotion {
  Vector3 point{};     ///< that moves with `velocity`
  Vector3 velocity{};  ///< [m]
  Vector3 turn{};      ///< angular velocity; zero: it slides
};

/// Where a motion's axis runs, and how far it goes along it per turn of 1 rad.
struct Screw {
  Vector3 point{};      ///< of the axis
  Vector3 direction{};  ///< of length 1; of a motion that slides, where to
  double pitch = 0.0;   ///< [m]; infinite: it slides
};
/// @param size  a length of the grasp [m]: what turns less than 1e-9 over it slides
[[nodiscard]] Screw screw_of(const ObjectMotion& motion, double size);

struct InternalForces {
  std::size_t forces = 0;  ///< 3 of each hard contact, 4 of each soft one
  std::size_t rank = 0;    ///< of G: how many of the six the contacts can bear at all
  /// How many combinations press the fingers against each other alone: forces - rank.
  [[nodiscard]] std::size_t count() const noexcept { return forces - rank; }
  /// Of them, those that no joint's torque feels: the hand's bones bear them. Absent: a finger's
  /// joints are not known.
  std::optional<std::size_t> without_torque{};
  std::vector<ObjectMotion> free{};  ///< of the object, which no contact resists, cones aside

  /// The forces' internal part as pushes of two contacts against each other; up to four contacts.
  struct Pair {
    std::size_t one = 0;
    std::size_t other = 0;
    double push = 0.0;  ///< [N], > 0: towards each other
  };
  std::vector<Pair> pairs{};
  double rest = 0.0;  ///< what these do not hold: torsions, over their radius [N]
};

/// @param actions  forces of every finger: of `MeasuredSpaceGrasp` or `HeldSpaceGrasp`
/// @throw std::invalid_argument  a finger is wrong; not as many actions as fingers
[[nodiscard]] InternalForces internal_forces(std::span<const SpaceFinger> fingers,
                                             std::span<const SpaceAction> actions);

}  // namespace tactile_net
