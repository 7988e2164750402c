#include "tactile_net/skin/moving_contact.hpp"

#include <array>

#include "sensing/between_knots.hpp"

namespace tactile_net {

SkinContact contact_at(const SkinContactTrajectory& trajectory, double t) noexcept {
  return contact_between(
      trajectory, t,
      std::array{&SkinContact::y, &SkinContact::z, &SkinContact::radius,
                 &SkinContact::second_radius, &SkinContact::angle, &SkinContact::force,
                 &SkinContact::friction, &SkinContact::direction, &SkinContact::stick,
                 &SkinContact::torsion});
}

}  // namespace tactile_net
