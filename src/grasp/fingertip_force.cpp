#include "tactile_net/grasp/fingertip_force.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tactile_net {
namespace {

void require(bool holds, const Finger& finger, const char* rule) {
  if (!holds) throw std::invalid_argument("finger '" + finger.name + "': " + rule);
}

}  // namespace

FingertipForce fingertip_force(const UncertainResultant& resultant, double breadth) {
  if (!(breadth > 0.0) || !std::isfinite(breadth))
    throw std::invalid_argument("the pad's breadth must be > 0 and finite");
  if (!resultant.centre)
    throw std::domain_error("the normal force must be > 0: nothing presses on the pad");
  FingertipForce force;
  force.normal = breadth * resultant.normal.value;
  force.tangential = resultant.tangential ? breadth * resultant.tangential->value : 0.0;
  force.centre = resultant.centre->value;
  const std::array<double, 3> scale = {breadth, breadth, 1.0};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      force.covariance.values[3 * i + j] = scale[i] * scale[j] * resultant.covariance[3 * i + j];
  return force;
}

void check(const Finger& finger, const ContactPlace& place) {
  require(std::abs(place.centre) <= finger.pad.half_width, finger,
          "the contact must lie on the fingertip: |centre| <= the pad's half width");
  require(place.deviation >= 0.0 && std::isfinite(place.deviation), finger,
          "the centre's deviation must be >= 0 and finite");
}

void check(const Finger& finger, const FingertipForce& force) {
  require(force.normal > 0.0 && std::isfinite(force.normal), finger,
          "the normal force must be > 0 and finite: a finger pushes");
  require(std::isfinite(force.tangential), finger, "the tangential force must be finite");
  require(std::all_of(force.covariance.values.begin(), force.covariance.values.end(),
                      [](double value) { return std::isfinite(value); }),
          finger, "the covariance must be finite");
  check(finger, place_of(force));
}

}  // namespace tactile_net
