/// @file
/// A contact whose place and load change in time.
#pragma once

#include <vector>

#include "tactile_net/elasticity/contact.hpp"

namespace tactile_net {

/// The contact at one moment; what moves is a straight line from knot to knot.
struct ContactKnot {
  double time = 0.0;  ///< [s], >= 0
  RigidContact contact{};
};

/// Knots in rising time; none: the contact stands still. Before the first knot the contact is that
/// of the first, after the last that of the last.
using ContactTrajectory = std::vector<ContactKnot>;

/// Centre, half width, force and friction at time t [s]; shape and edge are the first knot's.
///
/// @pre  there is a knot
[[nodiscard]] RigidContact contact_at(const ContactTrajectory& trajectory, double t) noexcept;

}  // namespace tactile_net
