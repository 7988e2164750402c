/// @file
/// What of a grasp's answer cannot hold, or only just does: in the plane and in space. Private.
#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tactile_net/lab/grasp.hpp"

namespace tactile_net::lab {

/// @param fingers  of the hand's file, with friction and limits
/// @param actions  what each does, for friction at the contact nearest to slipping
[[nodiscard]] std::vector<FingerMargins> margins_of(const auto& fingers, const auto& actions) {
  std::vector<FingerMargins> margins;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const auto& finger = fingers[i];
    FingerMargins one;
    if (finger.friction) one.friction = friction_margin(actions[i], *finger.friction);
    for (std::size_t j = 0; j < finger.torque_limits.size(); ++j)
      one.torques.push_back(torque_margin(actions[i].torques[j].value, finger.torque_limits[j]));
    margins.push_back(std::move(one));
  }
  return margins;
}

/// Adds to the result's remarks and failures.
void find_weak(auto& result, GraspAnswer answer, const auto& actions,
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

void require_finite(const auto& actions) {
  for (const auto& action : actions)
    for (const Uncertain& torque : action.torques)
      if (!std::isfinite(torque.value) || !std::isfinite(torque.deviation))
        throw std::domain_error("the torques overflow a double; choose other units");
}

/// Margins of what a grasp's fingers do, and what of it is weak.
///
/// @param gripping  the same at the contacts that are nearest to slipping
void judge(auto& result, GraspAnswer which, auto& answer, const auto& gripping) {
  require_finite(answer.grasp.fingers);
  answer.margins = margins_of(result.hand.fingers, gripping);
  find_weak(result, which, answer.grasp.fingers, answer.margins);
}

/// Whether the forces carry the load within their deviations; a failure if they do not.
[[nodiscard]] std::optional<bool> balanced(auto& result, const std::optional<double>& chi_squared,
                                           double limit) {
  if (!result.hand.load || !chi_squared) return std::nullopt;
  if (*chi_squared <= limit) return true;
  result.failures.push_back({.kind = GraspFailure::Kind::unbalanced, .number = *chi_squared});
  return false;
}

/// As a hold keeps to it: the share of each finger's friction that may be used; empty: no cones.
[[nodiscard]] std::vector<double> friction_used(const auto& hand) {
  std::vector<double> friction;
  for (const auto& finger : hand.fingers)
    if (hand.friction_used) friction.push_back(*hand.friction_used * *finger.friction);
  return friction;
}

/// Makes the fingertips, then what of their grasp can be known.
///
/// @param squeezed  the hand asks for a squeeze
/// @param measure   of (result, fingers): where every force is known
/// @param hold      of (result, fingers): where there is something to hold
template <class Result>
[[nodiscard]] Result grasp_of(const auto& hand, bool squeezed, auto maker, Observer& observer,
                              const auto& measure, const auto& hold) {
  Result result{.hand = hand};
  std::vector<decltype(result.tips.front().finger)> fingers;
  bool known = true;
  for (const auto& finger : hand.fingers) {
    observer.step({.kind = Step::Kind::finger, .count = fingers.size() + 1});
    result.tips.push_back(maker.make(finger));
    fingers.push_back(result.tips.back().finger);
    known = known && result.tips.back().force;
  }
  const bool asked = (hand.load || squeezed) && fingers.size() >= 2;
  if (!known && !asked)
    throw std::invalid_argument(
        "nothing to compute: no contact's force is known, and there is neither a [load] nor a "
        "squeeze for two fingers to hold");
  if (known) measure(result, fingers);
  if (asked) hold(result, fingers);
  return result;
}

}  // namespace tactile_net::lab
