/// @file
/// A hand of the plane as one in space, and two fingertips that face each other.
#pragma once

#include <vector>

#include "tests/grasp/space/space_hands.hpp"

namespace tactile_net {

/// The plane's X and Y are the first two axes; all joints turn about the third.
inline SpaceHand embedded(const Hand& plane, const std::vector<FingertipForce>& forces) {
  SpaceHand hand;
  const auto lifted = [](Vector2 v) { return Vector3{v.x, v.y, 0.0}; };
  for (std::size_t i = 0; i < plane.fingers.size(); ++i) {
    const FingerPose pose = pose_of(plane.fingers[i]);
    SpaceFinger finger{.name = plane.fingers[i].name,
                       .place = lifted(pose.pad_center),
                       .normal = lifted(pose.inward),
                       .tangent = lifted(pose.along)};
    for (const Vector2 joint : pose.joints)
      finger.joints.push_back({lifted(joint), {0.0, 0.0, 1.0}});
    SpaceFingertipForce force{.normal = forces[i].normal,
                              .tangential_y = forces[i].tangential,
                              .place = {forces[i].centre, 0.0}};
    const std::size_t from[] = {0, 1, 3};  // of normal, tangential, centre
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        force.covariance[6 * from[a] + from[b]] = forces[i].covariance.values[3 * a + b];
    hand.fingers.push_back(finger);
    hand.forces.push_back(force);
  }
  hand.load = {lifted(plane.load.force), {0.0, 0.0, plane.load.torque}, lifted(plane.load.point)};
  return hand;
}

/// At X = -1 and 1, pressing towards each other; without joints.
/// @param torsion_radius  0: hard
inline SpaceHand two_opposed(double torsion_radius, const SpaceLoad& load) {
  SpaceHand hand{.load = load};
  for (const double side : {-1.0, 1.0}) {
    hand.fingers.push_back({.name = side < 0.0 ? "left" : "right",
                            .place = {side, 0.0, 0.0},
                            .normal = {side, 0.0, 0.0},
                            .tangent = {0.0, 0.0, 1.0}});
    SpaceFingertipForce force{.normal = 1.0};
    if (torsion_radius > 0.0) force.place.torsion_radius = torsion_radius;
    hand.forces.push_back(force);
  }
  return hand;
}

}  // namespace tactile_net
