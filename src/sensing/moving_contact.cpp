#include "tactile_net/sensing/moving_contact.hpp"

#include <algorithm>
#include <cmath>

namespace tactile_net {

RigidContact contact_at(const ContactTrajectory& trajectory, double t) noexcept {
  const auto next =
      std::upper_bound(trajectory.begin(), trajectory.end(), t,
                       [](double time, const ContactKnot& knot) { return time < knot.time; });
  if (next == trajectory.begin()) return trajectory.front().contact;
  if (next == trajectory.end()) return trajectory.back().contact;
  const ContactKnot& last = *std::prev(next);
  const double share = (t - last.time) / (next->time - last.time);
  RigidContact contact = last.contact;
  for (const auto member : {&RigidContact::center, &RigidContact::half_width, &RigidContact::force,
                            &RigidContact::friction})
    contact.*member = std::lerp(last.contact.*member, next->contact.*member, share);
  return contact;
}

}  // namespace tactile_net
