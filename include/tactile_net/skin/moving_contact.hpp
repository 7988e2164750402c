/// @file
/// A contact on a skin whose place and load change in time.
#pragma once

#include <vector>

#include "tactile_net/skin/load.hpp"

namespace tactile_net {

/// The contact at one moment; what moves is a straight line from knot to knot.
struct SkinContactKnot {
  double time = 0.0;  ///< [s], >= 0
  SkinContact contact{};
};

/// Knots in rising time; none: the contact stands still. Before the first knot the contact is that
/// of the first, after the last that of the last.
using SkinContactTrajectory = std::vector<SkinContactKnot>;

/// The contact at time t [s]; its shape is the first knot's. Angles turn through all
/// values between: from 350 to 370 degrees by 20, from 350 to 10 by 340 back.
///
/// @pre  there is a knot
[[nodiscard]] SkinContact contact_at(const SkinContactTrajectory& trajectory, double t) noexcept;

}  // namespace tactile_net
