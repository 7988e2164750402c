/// @file
/// A planar finger: a chain of links with revolute joints, and a tactile pad on the last one.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/grasp/vector2.hpp"

namespace tactile_net {

/// A side of the last link, as seen from its joint towards the tip.
enum class Side { left, right };

/// The tactile pad: a flat surface, with the sensor's y along it and x into it.
struct Pad {
  double center = 0.0;      ///< pad's middle, from the last joint along the link [m]
  double height = 0.0;      ///< of the pad's surface above the link's axis, towards `side` [m]
  double tilt = 0.0;        ///< of the pad's surface from the link, counter-clockwise [rad]
  double half_width = 0.0;  ///< A: it reaches from y = -A to A [m], > 0
  Side side = Side::left;   ///< where the pad faces
  bool reversed = false;    ///< the sensor's y points to the last joint, not to the tip
};

struct Finger {
  std::string name{};            ///< for messages
  Vector2 base{};                ///< the first joint, in the palm's frame [m]
  double direction = 0.0;        ///< of the first link where its joint's angle is 0, from X [rad]
  std::vector<double> links{};   ///< lengths from joint to joint, the last one's to the tip [m]
  std::vector<double> angles{};  ///< of each link from the one before it, counter-clockwise [rad]
  Pad pad{};
};

/// A finger in the palm's frame.
struct FingerPose {
  std::vector<Vector2> joints{};
  Vector2 tip{};
  Vector2 pad_center{};  ///< where y = 0 [m]
  Vector2 along{};       ///< the sensor's y, of length 1
  Vector2 inward{};      ///< the sensor's x, into the pad, of length 1
};

/// @throw std::invalid_argument  no link, not as many angles as links, a length is not > 0, a
///                               number is not finite; the text names the finger
void check(const Finger& finger);

/// @throw std::invalid_argument  as `check`
[[nodiscard]] FingerPose pose_of(const Finger& finger);

/// The point O of the pad's surface at y, in the palm's frame [m].
[[nodiscard]] inline Vector2 contact_point(const FingerPose& pose, double y) noexcept {
  return pose.pad_center + y * pose.along;
}

/// True if every joint and the contact point lie on one line, as at a joint angle of 0 or pi: then
/// J is singular, and no torque pushes along that line. For two joints and more; one joint never
/// is.
[[nodiscard]] bool is_straight(const FingerPose& pose, Vector2 contact);

/// What is wrong with a straight finger, as every error says it.
inline constexpr const char* straight_finger =
    "its joints and the contact lie on one line, along which its torques cannot push";

/// @throw std::invalid_argument  the finger is straight; the text names it
void check_bent(const Finger& finger, const FingerPose& pose, Vector2 contact);

}  // namespace tactile_net
