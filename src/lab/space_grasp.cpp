#include "tactile_net/lab/space_grasp.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lab/grasp_weakness.hpp"
#include "lab/space_fingertip_maker.hpp"

namespace tactile_net::lab {
namespace {

void measure(SpaceGraspResult& result, const std::vector<SpaceFinger>& fingers) {
  std::vector<SpaceFingertipForce> forces;
  for (const SpaceFingertip& tip : result.tips) forces.push_back(*tip.force);
  MeasuredSpaceAnswer& answer = result.measured.emplace();
  answer.grasp = measured_grasp(fingers, forces, result.hand.load.value_or(SpaceLoad{}));
  judge(result, GraspAnswer::measured, answer);
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

void hold_load(SpaceGraspResult& result, const std::vector<SpaceFinger>& fingers) {
  const SpaceHand& hand = result.hand;
  std::vector<SpaceContactPlace> places;
  for (const SpaceFingertip& tip : result.tips) places.push_back(tip.place);
  SpaceHoldOptions options{.squeeze = hand.squeeze, .least = hand.least};
  if (hand.friction_used)
    for (const SpaceHandFinger& finger : hand.fingers)
      options.friction.push_back(*hand.friction_used * *finger.friction);
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
  judge(result, GraspAnswer::held, answer);
  answer.internal = internal_forces(fingers, answer.grasp.fingers);
  result.held = std::move(answer);
}

}  // namespace

SpaceGraspResult hold(const SpaceHand& hand, const SkinFrameOf& readings, Observer& observer) {
  SpaceGraspResult result{.hand = hand};
  SpaceFingertipMaker maker(hand.folder, readings);
  std::vector<SpaceFinger> fingers;
  for (const SpaceHandFinger& finger : hand.fingers) {
    observer.step({.kind = Step::Kind::finger, .count = fingers.size() + 1});
    result.tips.push_back(maker.make(finger));
    fingers.push_back(finger.finger);
  }
  const bool known = std::all_of(result.tips.begin(), result.tips.end(),
                                 [](const SpaceFingertip& tip) { return tip.force.has_value(); });
  const bool asked = (hand.load || hand.squeeze) && fingers.size() >= 2;
  if (!known && !asked) throw std::invalid_argument(nothing_to_compute);
  if (known) measure(result, fingers);
  if (asked) hold_load(result, fingers);
  return result;
}

}  // namespace tactile_net::lab
