/// @file
/// What moves along straight lines from knot to knot. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tactile_net {

/// The contact at time t: before the first knot as there, after the last as there.
///
/// @param moving  pointers to the members that move; the others are the last knot's
/// @pre  there is a knot
template <class Trajectory, class Members>
[[nodiscard]] auto contact_between(const Trajectory& trajectory, double t,
                                   const Members& moving) noexcept {
  const auto next =
      std::upper_bound(trajectory.begin(), trajectory.end(), t,
                       [](double time, const auto& knot) { return time < knot.time; });
  if (next == trajectory.begin()) return trajectory.front().contact;
  if (next == trajectory.end()) return trajectory.back().contact;
  const auto& last = *std::prev(next);
  const double share = (t - last.time) / (next->time - last.time);
  auto contact = last.contact;
  for (const auto member : moving)
    contact.*member = std::lerp(last.contact.*member, next->contact.*member, share);
  return contact;
}

}  // namespace tactile_net
