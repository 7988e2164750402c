#include "tactile_net/lab/space_grasp.hpp"

#include <cmath>
#include <utility>

#include "lab/grasp_weakness.hpp"
#include "lab/space_fingertip_maker.hpp"

namespace tactile_net::lab {
namespace {

/// What fingers do, with the force of the contact nearest to slipping for the sum of several.
std::vector<SpaceAction> at_nearest_to_slipping(std::vector<SpaceAction> actions,
                                                const std::vector<SpaceFingertip>& tips) {
  constexpr std::size_t felt[] = {0, 1, 2, 5};  // of a force's six values
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (!tips[i].nearest_to_slipping) continue;
    const SpaceFingertipForce& force = *tips[i].nearest_to_slipping;
    SpaceAction& action = actions[i];
    action.normal = force.normal;
    action.tangential_y = force.tangential_y;
    action.tangential_z = force.tangential_z;
    action.torsion = force.torsion;
    action.torsion_radius = force.place.torsion_radius;
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k)
        action.covariance[4 * j + k] = force.covariance[6 * felt[j] + felt[k]];
  }
  return actions;
}

void measure_in_space(SpaceGraspResult& result, const std::vector<SpaceFinger>& fingers) {
  std::vector<SpaceFingertipForce> forces;
  for (const SpaceFingertip& tip : result.tips) forces.push_back(*tip.force);
  MeasuredSpaceAnswer& answer = result.measured.emplace();
  answer.grasp = measured_grasp(fingers, forces, result.hand.load.value_or(SpaceLoad{}));
  judge(result, GraspAnswer::measured, answer,
        at_nearest_to_slipping(answer.grasp.fingers, result.tips));
  answer.balanced = balanced(result, answer.grasp.chi_squared, balanced_space_limit);
  answer.internal = internal_forces(fingers, answer.grasp.fingers);
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

void hold_in_space(SpaceGraspResult& result, const std::vector<SpaceFinger>& fingers) {
  const SpaceHand& hand = result.hand;
  std::vector<SpaceContactPlace> places;
  for (const SpaceFingertip& tip : result.tips) places.push_back(tip.place);
  const HoldOptions options{
      .squeeze = hand.squeeze, .friction = friction_used(hand), .least = hand.least};
  HeldSpaceAnswer answer;
  try {
    answer.grasp = tactile_net::hold(fingers, places, hand.load.value_or(SpaceLoad{}), options);
  } catch (const CannotHoldInSpace& error) {
    result.failures.push_back({.kind = GraspFailure::Kind::cannot_hold,
                               .answer = GraspAnswer::held,
                               .reason = error.reason()});
    result.refusal = {error.motion(), spread_of(result), error.least_squeeze()};
    return;
  }
  judge(result, GraspAnswer::held, answer, answer.grasp.fingers);
  answer.internal = internal_forces(fingers, answer.grasp.fingers);
  result.held = std::move(answer);
}

}  // namespace

SpaceGraspResult hold(const SpaceHand& hand, const SkinFrameOf& readings, Observer& observer) {
  return grasp_of<SpaceGraspResult>(hand, hand.squeeze.has_value(),
                                    SpaceFingertipMaker(hand.folder, readings), observer,
                                    measure_in_space, hold_in_space);
}

}  // namespace tactile_net::lab
