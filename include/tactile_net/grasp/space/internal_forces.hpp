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
  Vector3 point{};     ///< a point that moves with `velocity`
  Vector3 velocity{};  ///< velocity of `point` [m]
  Vector3 turn{};      ///< angular velocity; zero: it slides
};

/// Where a motion's axis runs, and how far it goes along it per turn of 1 rad.
struct Screw {
  Vector3 point{};      ///< a point of the axis
  Vector3 direction{};  ///< of the axis, of length 1; of the motion, if it slides
  double pitch = 0.0;   ///< [m]; infinite: it slides
};
/// The screw of a motion.
/// @param size  a length of the grasp [m]: a motion that turns less than 1e-9 over it slides
[[nodiscard]] Screw screw_of(const ObjectMotion& motion, double size);

struct InternalForces {
  std::size_t forces = 0;  ///< 3 of each hard contact, 4 of each soft one
  std::size_t rank = 0;    ///< rank of G: how many of the six numbers the contacts can bear
  /// Number of combinations that press the fingers against each other alone: forces - rank.
  [[nodiscard]] std::size_t count() const noexcept { return forces - rank; }
  /// Number of internal combinations that no joint's torque feels: the hand's bones bear them.
  /// Absent: a finger's joints are not known.
  std::optional<std::size_t> without_torque{};
  std::vector<ObjectMotion> free{};  ///< motions of the object that no contact resists, cones aside

  /// The forces' internal part as pushes of two contacts against each other; up to four contacts.
  struct Pair {
    std::size_t first = 0;   ///< index of the first finger
    std::size_t second = 0;  ///< index of the second finger
    double push = 0.0;       ///< [N], > 0: towards each other
  };
  std::vector<Pair> pairs{};
  double rest = 0.0;  ///< what no pair holds: torsions, over their radius [N]
};

/// Splits the forces of a grasp into what carries the load and what is internal.
/// @param actions  forces of every finger, from `MeasuredSpaceGrasp` or `HeldSpaceGrasp`
/// @throw std::invalid_argument  a finger is wrong; not as many actions as fingers
[[nodiscard]] InternalForces internal_forces(std::span<const SpaceFinger> fingers,
                                             std::span<const SpaceAction> actions);

}  // namespace tactile_net
