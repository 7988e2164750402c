#include "tactile_net/lab/space_grasp.hpp"

#include <cmath>
#include <utility>

#include "lab/fingertip_maker.hpp"
#include "lab/grasp_weakness.hpp"

namespace tactile_net::lab {
namespace {

void put_space_force(SpaceAction& action, const SpaceFingertipForce& force) {
  constexpr std::size_t felt[] = {0, 1, 2, 5};  // of a force's six values
  action.normal = force.normal;
  action.tangential_y = force.tangential_y;
  action.tangential_z = force.tangential_z;
  action.torsion = force.torsion;
  action.torsion_radius = force.place.torsion_radius;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t k = 0; k < 4; ++k)
      action.covariance[4 * j + k] = force.covariance[6 * felt[j] + felt[k]];
}

/// Root of the mean square distance of the contacts from their middle.
double spread_of(const SpaceGraspResult& result) {
  const double share = 1.0 / static_cast<double>(result.tips.size());
  Vector3 middle;
  const auto point = [](const SpaceFingertip& tip) {
    return contact_point(tip.pad, tip.place.y, tip.place.z);
  };
  for (const SpaceFingertip& tip : result.tips) middle = middle + share * point(tip);
  double spread = 0.0;
  for (const SpaceFingertip& tip : result.tips)
    spread = std::hypot(spread, length(point(tip) - middle));
  return std::sqrt(share) * spread;
}

void measure_in_space(SpaceGraspResult& result, const std::vector<SpaceFinger>& fingers) {
  MeasuredSpaceAnswer& answer = measure(result, fingers, put_space_force, balanced_space_limit);
  answer.internal = internal_forces(fingers, answer.grasp.fingers);
}

void hold_in_space(SpaceGraspResult& result, const std::vector<SpaceFinger>& fingers) {
  const SpaceHand& hand = result.hand;
  const HoldOptions options{
      .squeeze = hand.squeeze, .friction = friction_used(hand), .least = hand.least};
  HeldSpaceAnswer answer;
  if (!find_hold<CannotHoldInSpace>(
          result, answer,
          [&] {
            return tactile_net::hold(fingers, contact_places(result), load_on(hand), options);
          },
          [&](const CannotHoldInSpace& error) {
            result.refusal = {error.motion(), spread_of(result), error.least_squeeze()};
          }))
    return;
  answer.internal = internal_forces(fingers, answer.grasp.fingers);
  result.held = std::move(answer);
}

}  // namespace

SpaceGraspResult hold(const SpaceHand& hand, const SkinFrameOf& readings, Observer& observer) {
  return grasp_of<SpaceGraspResult>(hand, hand.squeeze.has_value(),
                                    FingertipMaker(hand.folder, readings), observer,
                                    measure_in_space, hold_in_space);
}

}  // namespace tactile_net::lab
