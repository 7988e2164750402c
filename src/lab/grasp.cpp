#include "tactile_net/lab/grasp.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lab/fingertip_maker.hpp"

namespace tactile_net::lab {
namespace {

std::vector<FingerMargins> margins_of(const Hand& hand, const std::vector<FingerAction>& actions) {
  std::vector<FingerMargins> margins;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const HandFinger& finger = hand.fingers[i];
    FingerMargins one;
    if (finger.friction) one.friction = friction_margin(actions[i], *finger.friction);
    for (std::size_t j = 0; j < finger.torque_limits.size(); ++j)
      one.torques.push_back(torque_margin(actions[i].torques[j].value, finger.torque_limits[j]));
    margins.push_back(std::move(one));
  }
  return margins;
}

/// Finds what of one answer cannot hold, or only just does.
void find_weak(GraspResult& result, GraspAnswer answer, const std::vector<FingerAction>& actions,
               const std::vector<FingerMargins>& margins) {
  using Weak = GraspRemark::Kind;
  using Failed = GraspFailure::Kind;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const auto& friction = margins[i].friction;
    if (is_idle(actions[i]))
      result.remarks.push_back({Weak::idle, answer, i});
    else if (!(actions[i].normal > 0.0))
      result.failures.push_back(
          {.kind = Failed::pulls, .answer = answer, .finger = i, .number = -actions[i].normal});
    else if (friction && friction->verdict == ContactVerdict::slips)
      result.failures.push_back({.kind = Failed::slips,
                                 .answer = answer,
                                 .finger = i,
                                 .number = -friction->distance.value});
    else if (friction && friction->distance.value < 2.0 * friction->distance.deviation)
      result.remarks.push_back({Weak::near_slipping, answer, i});
    for (std::size_t j = 0; j < margins[i].torques.size(); ++j)
      if (margins[i].torques[j].left < 0.0)
        result.failures.push_back({.kind = Failed::beyond_limit,
                                   .answer = answer,
                                   .finger = i,
                                   .joint = j,
                                   .number = -margins[i].torques[j].left});
  }
}

void require_finite(const std::vector<FingerAction>& actions) {
  for (const FingerAction& action : actions)
    for (const Uncertain& torque : action.torques)
      if (!std::isfinite(torque.value) || !std::isfinite(torque.deviation))
        throw std::domain_error("the torques overflow a double; choose other units");
}

void measure(GraspResult& result, const std::vector<Finger>& fingers) {
  std::vector<FingertipForce> forces;
  for (const Fingertip& tip : result.tips) forces.push_back(*tip.force);
  const auto& load = result.hand.load;
  MeasuredAnswer& answer = result.measured.emplace();
  answer.grasp = measured_grasp(fingers, forces, load.value_or(ExternalLoad{}));
  require_finite(answer.grasp.fingers);
  answer.margins = margins_of(result.hand, answer.grasp.fingers);
  find_weak(result, GraspAnswer::measured, answer.grasp.fingers, answer.margins);
  const auto& chi_squared = answer.grasp.chi_squared;
  if (!load || !chi_squared) return;
  answer.balanced = *chi_squared <= balanced_limit;
  if (!*answer.balanced)
    result.failures.push_back({.kind = GraspFailure::Kind::unbalanced, .number = *chi_squared});
}

/// The thesis' torques beside the general ones, for two fingers of two links.
TorqueWitness witness_of(const std::vector<Finger>& fingers,
                         const std::vector<ContactPlace>& places, const ExternalLoad& load,
                         double grasping_force, const HeldGrasp& held) {
  TorqueWitness witness{.torques = two_finger_torques(fingers[0], places[0].centre, fingers[1],
                                                      places[1].centre, load, grasping_force)};
  double size = 0.0;
  for (std::size_t j = 0; j < 2; ++j) {
    const double left = held.fingers[0].torques[j].value;
    const double right = held.fingers[1].torques[j].value;
    size = std::max({size, std::abs(left), std::abs(right)});
    witness.difference = std::max({witness.difference, std::abs(left - witness.torques.left[j]),
                                   std::abs(right - witness.torques.right[j])});
  }
  if (size > 0.0) witness.difference /= size;
  return witness;
}

void hold_load(GraspResult& result, const std::vector<Finger>& fingers) {
  const Hand& hand = result.hand;
  const ExternalLoad load = hand.load.value_or(ExternalLoad{});
  std::vector<ContactPlace> places;
  for (const Fingertip& tip : result.tips) places.push_back(tip.place);
  HoldOptions options = hand.squeeze;
  if (hand.friction_used)
    for (const HandFinger& finger : hand.fingers)
      options.friction.push_back(*hand.friction_used * *finger.friction);
  HeldAnswer answer;
  try {
    answer.grasp = tactile_net::hold(fingers, places, load, options);
  } catch (const CannotHold& error) {
    result.failures.push_back({.kind = GraspFailure::Kind::cannot_hold,
                               .answer = GraspAnswer::held,
                               .reason = error.reason()});
    return;
  }
  require_finite(answer.grasp.fingers);
  answer.margins = margins_of(hand, answer.grasp.fingers);
  find_weak(result, GraspAnswer::held, answer.grasp.fingers, answer.margins);
  const bool as_thesis = fingers.size() == 2 && fingers[0].links.size() == 2 &&
                         fingers[1].links.size() == 2 && hand.squeeze.grasping_force;
  if (as_thesis) {
    answer.thesis = witness_of(fingers, places, load, *hand.squeeze.grasping_force, answer.grasp);
    const double rounding = 1e-13 * (answer.thesis->torques.condition + answer.grasp.condition);
    if (answer.thesis->difference > rounding)
      result.failures.push_back({.kind = GraspFailure::Kind::disagreement,
                                 .answer = GraspAnswer::held,
                                 .number = answer.thesis->difference});
  }
  result.held = std::move(answer);
}

}  // namespace

GraspResult hold(const Hand& hand, const FrameOf& frame_of, Observer& observer) {
  GraspResult result{.hand = hand};
  FingertipMaker maker(hand.folder, frame_of);
  std::vector<Finger> fingers;
  for (const HandFinger& finger : hand.fingers) {
    observer.step({.kind = Step::Kind::finger, .count = fingers.size() + 1});
    result.tips.push_back(maker.make(finger));
    fingers.push_back(result.tips.back().finger);
  }
  const bool known = std::all_of(result.tips.begin(), result.tips.end(),
                                 [](const Fingertip& tip) { return tip.force.has_value(); });
  const bool asked =
      (hand.load || hand.squeeze.grasping_force || hand.squeeze.squeeze) && fingers.size() >= 2;
  if (!known && !asked)
    throw std::invalid_argument(
        "nothing to compute: no contact's force is known, and there is neither a [load] nor a "
        "squeeze for two fingers to hold");
  if (known) measure(result, fingers);
  if (asked) hold_load(result, fingers);
  return result;
}

}  // namespace tactile_net::lab
