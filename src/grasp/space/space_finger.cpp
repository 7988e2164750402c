#include "tactile_net/grasp/space/space_finger.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tactile_net {
namespace {

Vector3 unit(Vector3 v) { return 1.0 / length(v) * v; }

}  // namespace

void check(const SpaceFinger& finger) {
  const auto require = [&](bool holds, const char* rule) {
    if (!holds) throw std::invalid_argument("finger '" + finger.name + "': " + rule);
  };
  require(is_finite(finger.place) && is_finite(finger.normal) && is_finite(finger.tangent),
          "its place, normal and tangent must be finite");
  require(length(finger.normal) > 0.0, "its normal must not be zero");
  require(length(finger.tangent) > 0.0, "its tangent must not be zero");
  require(std::abs(dot(unit(finger.normal), unit(finger.tangent))) <= most_skew,
          "its normal and tangent must be at right angles");
  require(finger.joints.empty() || finger.jacobian.values.empty(),
          "joints and a Jacobian exclude each other");
  for (const SpaceJoint& joint : finger.joints)
    require(is_finite(joint.place) && is_finite(joint.axis) && length(joint.axis) > 0.0,
            "a joint's place and axis must be finite, and its axis not zero");
  const Matrix& j = finger.jacobian;
  require(j.values.empty() || (j.rows == 6 && j.values.size() == 6 * j.columns),
          "its Jacobian must have six rows");
  require(std::all_of(j.values.begin(), j.values.end(), [](double v) { return std::isfinite(v); }),
          "its Jacobian must be finite");
}

PadFrame pad_frame(const SpaceFinger& finger) {
  PadFrame pad{.origin = finger.place, .x = unit(finger.normal)};
  pad.y = unit(finger.tangent - dot(finger.tangent, pad.x) * pad.x);
  pad.z = cross(pad.x, pad.y);
  return pad;
}

std::size_t joint_count(const SpaceFinger& finger) noexcept {
  return finger.jacobian.values.empty() ? finger.joints.size() : finger.jacobian.columns;
}

JointMotion motion_of(const SpaceFinger& finger, std::size_t joint) {
  if (const Matrix& j = finger.jacobian; !j.values.empty())
    return {{j(0, joint), j(1, joint), j(2, joint)}, {j(3, joint), j(4, joint), j(5, joint)}};
  const SpaceJoint& one = finger.joints[joint];
  const Vector3 axis = unit(one.axis);
  if (one.slides) return {axis, {}};
  return {cross(axis, finger.place - one.place), axis};
}

}  // namespace tactile_net
