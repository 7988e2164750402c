/// @file
/// What of a grasp's answer cannot hold, or only just does: in the plane and in space. Private.
#pragma once

#include <cmath>
#include <stdexcept>
#include <type_traits>
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

/// None: of no force.
[[nodiscard]] auto load_on(const auto& hand) {
  return hand.load.value_or(typename std::remove_cvref_t<decltype(hand.load)>::value_type{});
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

/// What fingers do, with the force of the contact nearest to slipping for the sum of several.
///
/// @param put  of (action, force)
[[nodiscard]] auto at_nearest_to_slipping(auto actions, const auto& tips, const auto& put) {
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (tips[i].nearest_to_slipping) put(actions[i], *tips[i].nearest_to_slipping);
  return actions;
}

/// What the forces that are measured mean, and whether they carry the load.
///
/// @param put    as of `at_nearest_to_slipping`
/// @param limit  of chi squared, up to which they do
auto& measure(auto& result, const auto& fingers, const auto& put, double limit) {
  std::vector<std::remove_cvref_t<decltype(*result.tips.front().force)>> forces;
  for (const auto& tip : result.tips) forces.push_back(*tip.force);
  auto& answer = result.measured.emplace();
  answer.grasp = measured_grasp(fingers, forces, load_on(result.hand));
  judge(result, GraspAnswer::measured, answer,
        at_nearest_to_slipping(answer.grasp.fingers, result.tips, put));
  answer.balanced = balanced(result, answer.grasp.chi_squared, limit);
  return answer;
}

/// Where the fingers touch.
[[nodiscard]] auto contact_places(const auto& result) {
  std::vector<std::remove_cvref_t<decltype(result.tips.front().place)>> places;
  for (const auto& tip : result.tips) places.push_back(tip.place);
  return places;
}

/// What would hold the load.
///
/// @param answer   that is filled in
/// @param hold     gives the grasp
/// @param refused  of what `hold` throws where nothing holds
/// @return  something does
template <class CannotHoldIt>
[[nodiscard]] bool find_hold(auto& result, auto& answer, const auto& hold, const auto& refused) {
  try {
    answer.grasp = hold();
  } catch (const CannotHoldIt& error) {
    result.failures.push_back({.kind = GraspFailure::Kind::cannot_hold,
                               .answer = GraspAnswer::held,
                               .reason = error.reason()});
    refused(error);
    return false;
  }
  judge(result, GraspAnswer::held, answer, answer.grasp.fingers);
  return true;
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
