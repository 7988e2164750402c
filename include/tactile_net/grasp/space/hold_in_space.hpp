/// @file
/// The least torques, or the least forces, that hold a load in space inside the cones of friction.
///
///     const HeldSpaceGrasp grasp = hold(fingers, places, load, {.friction = {0.6, 0.6}});
///     grasp.fingers[0].torques;  // throws CannotHoldInSpace where no forces within the cones do
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tactile_net/grasp/cannot_hold.hpp"
#include "tactile_net/grasp/space/internal_forces.hpp"
#include "tactile_net/grasp/space/space_action.hpp"
#include "tactile_net/grasp/space/space_contact.hpp"
#include "tactile_net/grasp/space/space_finger.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// What `hold` minimises.
enum class Least { torques, forces };

template <>
struct Enumerators<Least> {
  static constexpr Enumerator<Least> all[] = {
      {Least::torques, "torques", "The sum of squares of all joint torques."},
      {Least::forces, "forces",
       "The sum of squares of all contact forces, torsions over their radius."}};
};

/// How hard to squeeze, beyond what equilibrium fixes: at most one of the first two. Neither: as
/// little as the least torques do.
struct HoldOptions {
  /// f_g (thesis 6.9), for two fingers: squeeze - |e.f_e|, with e along the line of contacts. The
  /// finger that the load presses less pushes with f_g / 2 along that line.
  std::optional<double> grasping_force{};
  /// Sum of the contact forces' components towards the mean of the contact points.
  std::optional<double> squeeze{};
  /// mu of each finger, > 0: every force stays within its cone, see `friction_margin`. Empty:
  /// friction does not enter, and a finger may be asked to pull.
  std::vector<double> friction{};
  Least least = Least::torques;
};

/// A grasp that holds the load. Deviations are those of the contacts' places, propagated. A force
/// on its cone is taken to stay there, and moments that the contacts cannot bear not to arise: two
/// hard fingers let the object turn about the line between them.
struct HeldSpaceGrasp {
  std::vector<SpaceAction> fingers{};
  Matrix torque_covariance{};  ///< covariance of all torques, finger after finger
  double squeeze = 0.0;
  double residual = 0.0;    ///< residual of equilibrium, over load and squeeze
  double optimality = 0.0;  ///< residual of the conditions for a minimum, over their terms
  int iterations = 0;       ///< of the interior-point method; 0: there are no cones, or edges alone
  /// Condition number of the scaled system, where all contacts are planar: digits lost are its
  /// logarithm.
  std::optional<double> condition{};
};

/// No forces within the cones hold the load, with the proof of it.
class CannotHoldInSpace : public CannotHold {
 public:
  CannotHoldInSpace(NoHold reason, std::optional<ObjectMotion> motion,
                    std::optional<double> least_squeeze)
      : CannotHold(reason), motion_(motion), least_squeeze_(least_squeeze) {}

  /// A motion of the object that the load drives, and against which no force within the cones does
  /// work: whoever doubts the answer can check both.
  [[nodiscard]] const std::optional<ObjectMotion>& motion() const noexcept { return motion_; }
  /// The least squeeze that would hold the load; present for `beyond_cones_squeezed` alone.
  [[nodiscard]] const std::optional<double>& least_squeeze() const noexcept {
    return least_squeeze_;
  }

 private:
  std::optional<ObjectMotion> motion_;
  std::optional<double> least_squeeze_;
};

/// Minimises what `least` says among the contact forces in equilibrium with the load, with the
/// squeeze that is asked for, inside the cones. A conic problem of second order, solved by a
/// homogeneous interior-point method with Nesterov and Todd's scaling (Andersen, Roos and Terlaky,
/// Mathematical Programming 95, 2003), then by Newton's method on the cones that are met: neither
/// squares the condition number. Where every contact is planar and hard, each cone is two edges,
/// and the forces along them are found by a dual method of active sets instead (Goldfarb and
/// Idnani, Mathematical Programming 27, 1983): it holds two edges that the minimum meets at once,
/// as in every symmetric gripper, by one of them.
///
/// @throw std::invalid_argument  fewer than two fingers; not as many contacts as fingers, or one is
///                               wrong (see `check`); friction of not all; a number is not finite;
///                               both options of squeezing, a grasping force of three fingers;
///                               contacts in one point; a squeeze with a contact in the contacts'
///                               middle; least torques of fingers whose joints are not known, or of
///                               joints of which some slide and some turn
/// @throw CannotHoldInSpace      no forces carry the load, with the reason and its proof; or the
///                               torques do not determine the forces
[[nodiscard]] HeldSpaceGrasp hold(std::span<const SpaceFinger> fingers,
                                  std::span<const SpaceContactPlace> contacts,
                                  const SpaceLoad& load, const HoldOptions& options = {});

}  // namespace tactile_net
