#include "tactile_net/grasp/space/space_contact.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

namespace tactile_net {
namespace {

void require(const SpaceFinger& finger, bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument("finger '" + finger.name + "': " + rule);
}

void check_variances(const SpaceFinger& finger, std::span<const double> covariance,
                     std::size_t size) {
  for (std::size_t i = 0; i < covariance.size(); ++i)
    require(finger, std::isfinite(covariance[i]) && (i % (size + 1) != 0 || covariance[i] >= 0.0),
            "the covariance of its contact must be finite, and its variances >= 0");
}

}  // namespace

double SpaceFingertipForce::deviation(SpaceContactValue value) const noexcept {
  return std::sqrt(std::fmax(covariance_of(value, value), 0.0));
}

SpaceContactPlace place_of(const SpaceFingertipForce& force) noexcept {
  using enum SpaceContactValue;
  SpaceContactPlace place = force.place;
  place.covariance = {
      force.covariance_of(centre_y, centre_y), force.covariance_of(centre_y, centre_z),
      force.covariance_of(centre_z, centre_y), force.covariance_of(centre_z, centre_z)};
  return place;
}

void check(const SpaceFinger& finger, const SpaceContactPlace& place) {
  check(finger);
  require(finger, std::isfinite(place.y) && std::isfinite(place.z),
          "the place of its contact must be finite");
  check_variances(finger, place.covariance, 2);
  require(finger,
          !place.torsion_radius ||
              (*place.torsion_radius > 0.0 && std::isfinite(*place.torsion_radius)),
          "the radius of its torsion must be > 0 and finite");
}

void check(const SpaceFinger& finger, const SpaceFingertipForce& force) {
  check(finger, force.place);
  require(finger,
          std::isfinite(force.normal) && std::isfinite(force.tangential_y) &&
              std::isfinite(force.tangential_z) && std::isfinite(force.torsion),
          "the forces of its contact must be finite");
  require(finger, force.normal > 0.0, "the normal force must be > 0: it points into the pad");
  require(finger, force.place.torsion_radius || force.torsion == 0.0,
          "a hard finger has no torsion: a soft one has a radius of it");
  require(finger, !force.place.planar || force.tangential_z == 0.0,
          "a planar contact has no force along z");
  check_variances(finger, force.covariance, 6);
}

}  // namespace tactile_net
