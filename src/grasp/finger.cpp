#include "tactile_net/grasp/finger.hpp"

#include <algorithm>
#include <stdexcept>

namespace tactile_net {
namespace {

/// Sine of the angle below which a finger is straight: torques would lose nine digits.
constexpr double straight = 1e-9;

bool finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

void check(const Finger& finger) {
  const auto require = [&](bool holds, const char* rule) {
    if (!holds) throw std::invalid_argument("finger '" + finger.name + "': " + rule);
  };
  const Pad& pad = finger.pad;
  require(!finger.links.empty(), "a finger has at least one link");
  require(finger.angles.size() == finger.links.size(), "there must be one angle for each link");
  require(finite(finger.links) && std::all_of(finger.links.begin(), finger.links.end(),
                                              [](double link) { return link > 0.0; }),
          "a link's length must be > 0 and finite");
  require(finite(finger.angles) && std::isfinite(finger.direction), "angles must be finite");
  require(std::isfinite(finger.base.x) && std::isfinite(finger.base.y), "its base must be finite");
  require(std::isfinite(pad.center) && std::isfinite(pad.height) && std::isfinite(pad.tilt),
          "its pad's place must be finite");
  require(pad.half_width > 0.0 && std::isfinite(pad.half_width),
          "its pad's half width must be > 0 and finite");
}

FingerPose pose_of(const Finger& finger) {
  check(finger);
  FingerPose pose;
  Vector2 end = finger.base;
  double angle = finger.direction;
  for (std::size_t i = 0; i < finger.links.size(); ++i) {
    pose.joints.push_back(end);
    angle += finger.angles[i];
    end = end + finger.links[i] * direction(angle);
  }
  pose.tip = end;
  const Pad& pad = finger.pad;
  const bool left = pad.side == Side::left;
  const Vector2 link = direction(angle);
  const Vector2 up = left ? quarter_turn(link) : -quarter_turn(link);
  pose.pad_center = pose.joints.back() + pad.center * link + pad.height * up;
  const Vector2 surface = direction(angle + pad.tilt);  // towards the tip
  pose.along = pad.reversed ? -surface : surface;
  pose.inward = left ? -quarter_turn(surface) : quarter_turn(surface);
  return pose;
}

bool is_straight(const FingerPose& pose, Vector2 contact) {
  if (pose.joints.size() < 2) return false;
  // J' is singular if all arms are parallel: compare each with the longest.
  Vector2 longest{};
  for (const Vector2 joint : pose.joints)
    if (length(contact - joint) > length(longest)) longest = contact - joint;
  return std::all_of(pose.joints.begin(), pose.joints.end(), [&](Vector2 joint) {
    return std::abs(cross(longest, contact - joint)) <=
           straight * length(longest) * length(longest);
  });
}

void check_bent(const Finger& finger, const FingerPose& pose, Vector2 contact) {
  if (is_straight(pose, contact))
    throw std::invalid_argument("finger '" + finger.name + "': it is straight: " + straight_finger);
}

}  // namespace tactile_net
