/// @file
/// A hand of the plane as one in space, and two fingertips that face each other.
#pragma once

#include <vector>

#include "tactile_net/grasp/in_space.hpp"
#include "tests/grasp/space/space_hands.hpp"

namespace tactile_net {

/// @param planar  false: contacts that bear forces across the plane too, which nothing asks of them
inline SpaceHand embedded(const Hand& plane, const std::vector<FingertipForce>& forces,
                          bool planar) {
  SpaceHand hand{.load = in_space(plane.load)};
  for (const Finger& finger : plane.fingers) hand.fingers.push_back(in_space(finger));
  for (const FingertipForce& force : forces) {
    hand.forces.push_back(in_space(force));
    hand.forces.back().place.planar = planar;
  }
  return hand;
}

/// Contacts that press somehow, at the hand's places.
inline SpaceHand embedded(const Hand& plane, bool planar) {
  std::vector<FingertipForce> forces;
  for (const ContactPlace& contact : plane.contacts) {
    FingertipForce force{.normal = 1.0, .centre = contact.centre};
    force.covariance(ContactValue::centre, ContactValue::centre) =
        contact.deviation * contact.deviation;
    forces.push_back(force);
  }
  return embedded(plane, forces, planar);
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
