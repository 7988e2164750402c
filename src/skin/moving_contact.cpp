#include "tactile_net/skin/moving_contact.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tactile_net {

SkinContact contact_at(const SkinContactTrajectory& trajectory, double t) noexcept {
  const auto next =
      std::upper_bound(trajectory.begin(), trajectory.end(), t,
                       [](double time, const SkinContactKnot& knot) { return time < knot.time; });
  if (next == trajectory.begin()) return trajectory.front().contact;
  if (next == trajectory.end()) return trajectory.back().contact;
  const SkinContactKnot& last = *std::prev(next);
  const double share = (t - last.time) / (next->time - last.time);
  SkinContact contact = last.contact;
  for (const auto member :
       {&SkinContact::y, &SkinContact::z, &SkinContact::radius, &SkinContact::second_radius,
        &SkinContact::angle, &SkinContact::force, &SkinContact::friction, &SkinContact::direction,
        &SkinContact::stick, &SkinContact::torsion})
    contact.*member = std::lerp(last.contact.*member, next->contact.*member, share);
  return contact;
}

}  // namespace tactile_net
