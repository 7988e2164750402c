/// @file
/// What a fingertip's tactile sensor says of its contact.
#pragma once

#include "tactile_net/grasp/contact_covariance.hpp"
#include "tactile_net/grasp/finger.hpp"
#include "tactile_net/inverse/uncertainty.hpp"

namespace tactile_net {

/// The resultant of the tractions on a pad: the object's force on the finger. With tractions of the
/// plane (Pa) forces are per unit length out of plane; times the pad's breadth they are in N.
struct FingertipForce {
  double normal = 0.0;      ///< F_v, into the pad; must be > 0
  double tangential = 0.0;  ///< F_t, along the sensor's y
  double centre = 0.0;      ///< y*, centre of pressure [m]
  ContactCovariance<3> covariance{};
};

/// @param breadth  of the pad out of plane [m], > 0; 1: forces stay per unit length
/// @throw std::invalid_argument  the breadth is not > 0 and finite
/// @throw std::domain_error      F_v <= 0: there is no point of action
[[nodiscard]] FingertipForce fingertip_force(const UncertainResultant& resultant, double breadth);

/// The place of a contact, without the force.
struct ContactPlace {
  double centre = 0.0;     ///< y* [m]
  double deviation = 0.0;  ///< its standard deviation [m], >= 0
};

/// Where a force acts, without the force.
[[nodiscard]] inline ContactPlace place_of(const FingertipForce& force) noexcept {
  return {force.centre, force.covariance.deviation(ContactValue::centre)};
}

/// @throw std::invalid_argument  the place is outside the pad, or not finite, or the deviation is
///                               not >= 0; the text names the finger
void check(const Finger& finger, const ContactPlace& place);

/// @throw std::invalid_argument  as for the place; F_v <= 0, or a number is not finite
void check(const Finger& finger, const FingertipForce& force);

}  // namespace tactile_net
