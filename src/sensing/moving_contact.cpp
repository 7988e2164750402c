#include "tactile_net/sensing/moving_contact.hpp"

#include <array>

#include "sensing/between_knots.hpp"

namespace tactile_net {

RigidContact contact_at(const ContactTrajectory& trajectory, double t) noexcept {
  return contact_between(trajectory, t,
                         std::array{&RigidContact::center, &RigidContact::half_width,
                                    &RigidContact::force, &RigidContact::friction});
}

}  // namespace tactile_net
