#include "tactile_net/lab/grasp.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"

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

/// What of one answer cannot hold, or only just does.
void judge(GraspStudy& study, const std::vector<FingerAction>& actions,
           const std::vector<FingerMargins>& margins, const std::string& which) {
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const std::string finger = which + ": finger '" + study.tips[i].finger.name + "' ";
    const auto& friction = margins[i].friction;
    if (is_idle(actions[i]))
      study.warnings.push_back(finger + "is not needed: it carries nothing");
    else if (!(actions[i].normal > 0.0))
      study.failures.push_back(finger + "would have to pull with " + brief(-actions[i].normal));
    else if (friction && friction->verdict == ContactVerdict::slips)
      study.failures.push_back(finger + "slips: its force is " + brief(-friction->distance.value) +
                               " outside the friction cone");
    else if (friction && friction->distance.value < 2.0 * friction->distance.deviation)
      study.warnings.push_back(finger + "is less than two standard deviations from slipping");
    for (std::size_t j = 0; j < margins[i].torques.size(); ++j)
      if (margins[i].torques[j].left < 0.0)
        study.failures.push_back(finger + "exceeds the torque limit of joint " +
                                 std::to_string(j + 1) + " by " +
                                 brief(-margins[i].torques[j].left));
  }
}

void require_finite(const std::vector<FingerAction>& actions) {
  for (const FingerAction& action : actions)
    for (const Uncertain& torque : action.torques)
      if (!std::isfinite(torque.value) || !std::isfinite(torque.deviation))
        throw std::domain_error("the torques overflow a double; choose other units");
}

void measure(GraspStudy& study, const std::vector<Finger>& fingers) {
  std::vector<FingertipForce> forces;
  for (const Fingertip& tip : study.tips) forces.push_back(*tip.force);
  study.measured = measured_grasp(fingers, forces, study.hand.load.value_or(ExternalLoad{}));
  const MeasuredGrasp& measured = *study.measured;
  require_finite(measured.fingers);
  study.measured_margins = margins_of(study.hand, measured.fingers);
  judge(study, measured.fingers, study.measured_margins, "as measured");
  if (!study.hand.load || !measured.chi_squared) return;
  study.balanced = *measured.chi_squared <= balanced_limit;
  if (!*study.balanced)
    study.failures.push_back("as measured: the forces do not carry the load: chi squared " +
                             brief(*measured.chi_squared) + ", beyond the " +
                             brief(balanced_limit) + " that 99 % of balanced grasps stay below");
}

void hold_load(GraspStudy& study, const std::vector<Finger>& fingers) {
  const Hand& hand = study.hand;
  const ExternalLoad load = hand.load.value_or(ExternalLoad{});
  std::vector<ContactPlace> places;
  for (const Fingertip& tip : study.tips) places.push_back(tip.place);
  HoldOptions options = hand.squeeze;
  if (hand.friction_used)
    for (const HandFinger& finger : hand.fingers)
      options.friction.push_back(*hand.friction_used * *finger.friction);
  try {
    study.held = hold(fingers, places, load, options);
  } catch (const std::domain_error& error) {
    study.failures.push_back(std::string("to hold: ") + error.what());
    return;
  }
  require_finite(study.held->fingers);
  study.held_margins = margins_of(hand, study.held->fingers);
  judge(study, study.held->fingers, study.held_margins, "to hold");
  const bool as_thesis = fingers.size() == 2 && fingers[0].links.size() == 2 &&
                         fingers[1].links.size() == 2 && hand.squeeze.grasping_force;
  if (!as_thesis) return;
  study.thesis = two_finger_torques(fingers[0], places[0].centre, fingers[1], places[1].centre,
                                    load, *hand.squeeze.grasping_force);
  double size = 0.0;
  for (std::size_t j = 0; j < 2; ++j) {
    const double left = study.held->fingers[0].torques[j].value;
    const double right = study.held->fingers[1].torques[j].value;
    size = std::max({size, std::abs(left), std::abs(right)});
    study.thesis_difference =
        std::max({study.thesis_difference, std::abs(left - study.thesis->left[j]),
                  std::abs(right - study.thesis->right[j])});
  }
  if (size > 0.0) study.thesis_difference /= size;
  if (study.thesis_difference > 1e-13 * (study.thesis->condition + study.held->condition))
    study.failures.push_back("to hold: the thesis' equations give other torques, by " +
                             brief(study.thesis_difference));
}

}  // namespace

GraspStudy study_grasp(const Hand& hand) {
  GraspStudy study{.hand = hand};
  std::vector<Finger> fingers;
  for (const HandFinger& finger : hand.fingers) {
    study.tips.push_back(make_fingertip(finger, hand.folder));
    const Fingertip& tip = study.tips.back();
    fingers.push_back(tip.finger);
    study.poses.push_back(pose_of(tip.finger));
    check_bent(tip.finger, study.poses.back(), contact_point(study.poses.back(), tip.place.centre));
    for (const std::string& warning : tip.warnings)
      study.warnings.push_back("finger '" + tip.finger.name + "': " + warning);
  }
  const bool known = std::all_of(study.tips.begin(), study.tips.end(),
                                 [](const Fingertip& tip) { return tip.force.has_value(); });
  if (known) measure(study, fingers);
  const bool asked = hand.load || hand.squeeze.grasping_force || hand.squeeze.squeeze;
  if (asked && fingers.size() >= 2) hold_load(study, fingers);
  if (!study.measured && !(asked && fingers.size() >= 2))
    throw std::invalid_argument(
        "nothing to compute: no contact's force is known, and there is neither a [load] nor a "
        "squeeze for two fingers to hold");
  return study;
}

}  // namespace tactile_net::lab
