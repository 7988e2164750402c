#include "tactile_net/lab/grasp.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lab/fingertip_maker.hpp"
#include "lab/grasp_weakness.hpp"

namespace tactile_net::lab {
namespace {

void put_plane_force(FingerAction& action, const FingertipForce& force) {
  using enum ContactValue;
  action.normal = force.normal;
  action.tangential = force.tangential;
  for (const ContactValue a : {normal, tangential})
    for (const ContactValue b : {normal, tangential})
      action.covariance(a, b) = force.covariance(a, b);
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
  const ExternalLoad load = load_on(hand);
  HoldOptions options = hand.squeeze;
  options.friction = friction_used(hand);
  const std::vector<ContactPlace> places = contact_places(result);
  HeldAnswer answer;
  if (!find_hold<CannotHold>(
          result, answer, [&] { return tactile_net::hold(fingers, places, load, options); },
          [](const CannotHold&) {}))
    return;
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
  const auto measured = [](GraspResult& result, const std::vector<Finger>& fingers) {
    measure(result, fingers, put_plane_force, balanced_limit);
  };
  return grasp_of<GraspResult>(hand, squeezed, FingertipMaker(hand.folder, frame_of), observer,
                               measured, hold_in_plane);
}

}  // namespace tactile_net::lab
