#include "tactile_net/lab/grasp.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lab/fingertip_maker.hpp"
#include "lab/grasp_weakness.hpp"

namespace tactile_net::lab {
namespace {

/// What fingers do, with the force of the contact nearest to slipping for the sum of several.
std::vector<FingerAction> at_nearest_to_slipping(std::vector<FingerAction> actions,
                                                 const std::vector<Fingertip>& tips) {
  using enum ContactValue;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (!tips[i].nearest_to_slipping) continue;
    const FingertipForce& force = *tips[i].nearest_to_slipping;
    actions[i].normal = force.normal;
    actions[i].tangential = force.tangential;
    for (const ContactValue a : {normal, tangential})
      for (const ContactValue b : {normal, tangential})
        actions[i].covariance(a, b) = force.covariance(a, b);
  }
  return actions;
}

void measure_in_plane(GraspResult& result, const std::vector<Finger>& fingers) {
  std::vector<FingertipForce> forces;
  for (const Fingertip& tip : result.tips) forces.push_back(*tip.force);
  const auto& load = result.hand.load;
  MeasuredAnswer& answer = result.measured.emplace();
  answer.grasp = measured_grasp(fingers, forces, load.value_or(ExternalLoad{}));
  judge(result, GraspAnswer::measured, answer,
        at_nearest_to_slipping(answer.grasp.fingers, result.tips));
  answer.balanced = balanced(result, answer.grasp.chi_squared, balanced_limit);
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

void hold_in_plane(GraspResult& result, const std::vector<Finger>& fingers) {
  const Hand& hand = result.hand;
  const ExternalLoad load = hand.load.value_or(ExternalLoad{});
  std::vector<ContactPlace> places;
  for (const Fingertip& tip : result.tips) places.push_back(tip.place);
  HoldOptions options = hand.squeeze;
  options.friction = friction_used(hand);
  HeldAnswer answer;
  try {
    answer.grasp = tactile_net::hold(fingers, places, load, options);
  } catch (const CannotHold& error) {
    result.failures.push_back({.kind = GraspFailure::Kind::cannot_hold,
                               .answer = GraspAnswer::held,
                               .reason = error.reason()});
    return;
  }
  judge(result, GraspAnswer::held, answer, answer.grasp.fingers);
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
  const bool squeezed = hand.squeeze.grasping_force || hand.squeeze.squeeze;
  return grasp_of<GraspResult>(hand, squeezed, FingertipMaker(hand.folder, frame_of), observer,
                               measure_in_plane, hold_in_plane);
}

}  // namespace tactile_net::lab
