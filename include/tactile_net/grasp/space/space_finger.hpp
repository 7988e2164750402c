/// @file
/// A finger in space: a skin on its tip, and the joints that move it, as they stand.
///
///     const SpaceFinger thumb{.name = "thumb", .place = {-0.03, 0.0, 0.1},
///                             .normal = {-1.0, 0.0, 0.0}, .tangent = {0.0, 0.0, 1.0},
///                             .joints = {{.place = {-0.03, 0.0, 0.0}, .axis = {0.0, 1.0, 0.0}}}};
///     check(thumb);
///     const PadFrame pad = pad_frame(thumb);
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tactile_net/grasp/space/vector3.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// A joint's axis in the hand's frame.
struct SpaceJoint {
  Vector3 place{};      ///< any point of it [m]; of no use to a joint that slides
  Vector3 axis{};       ///< its direction, of any length > 0; turns are right-handed about it
  bool slides = false;  ///< along the axis: its torque is a force
};

struct SpaceFinger {
  std::string name{};  ///< for messages
  Vector3 place{};     ///< place of the pad's y = z = 0, in the hand's frame [m]
  Vector3 normal{};    ///< x of the pad, into it, away from the object; of any length > 0
  Vector3 tangent{};   ///< y of the pad, across the normal
  /// The joints from the palm to the tip. Neither joints nor Jacobian: the finger's motion is not
  /// known.
  std::vector<SpaceJoint> joints{};
  /// In place of joints, 6 x joints: the velocity of the pad's place [m] and the angular velocity
  /// of the pad, per unit of each joint's.
  Matrix jacobian{};
};

/// The pad's axes, right-handed and of length 1: x into the pad, y and z along it.
struct PadFrame {
  Vector3 origin{};
  Vector3 x{}, y{}, z{};
};

/// Largest |cosine| of the angle between normal and tangent.
inline constexpr double most_skew = 1e-3;

/// @throw std::invalid_argument  a number is not finite, normal, tangent or an axis is zero, normal
///                               and tangent are not at right angles, both joints and a Jacobian,
///                               the Jacobian has not six rows; the text names the finger
void check(const SpaceFinger& finger);

/// The frame of a finger's pad; the tangent is turned until it is at right angles to the normal.
[[nodiscard]] PadFrame pad_frame(const SpaceFinger& finger);

[[nodiscard]] std::size_t joint_count(const SpaceFinger& finger) noexcept;

/// The point of the pad's surface at (y, z), in the hand's frame [m].
[[nodiscard]] inline Vector3 contact_point(const PadFrame& pad, double y, double z) noexcept {
  return pad.origin + y * pad.y + z * pad.z;
}

/// What one joint does to the finger's tip, per unit of its own motion.
struct JointMotion {
  Vector3 velocity{};  ///< velocity of `PadFrame::origin` [m], or without unit
  Vector3 turn{};      ///< angular velocity
};
/// The motion of the tip per unit of a joint's motion.
/// @param joint  < joint_count
[[nodiscard]] JointMotion motion_of(const SpaceFinger& finger, std::size_t joint);

}  // namespace tactile_net
