/// @file
/// How far a grasp is from slipping, and from the motors' limits.
#pragma once

#include <cmath>

#include "tactile_net/grasp/finger_action.hpp"
#include "tactile_net/inverse/uncertainty.hpp"

namespace tactile_net {

/// `idle`: no force at all. `slips`: the force is outside the cone of friction. `pulls`: the finger
/// would have to pull.
enum class ContactVerdict { holds, idle, slips, pulls };

[[nodiscard]] inline bool is_idle(const FingerAction& action) noexcept {
  return action.normal == 0.0 && action.tangential == 0.0;
}

[[nodiscard]] constexpr const char* name(ContactVerdict verdict) noexcept {
  switch (verdict) {
    case ContactVerdict::holds:
      return "holds";
    case ContactVerdict::idle:
      return "idle";
    case ContactVerdict::slips:
      return "slips";
    case ContactVerdict::pulls:
      return "pulls";
  }
  return "";
}

struct FrictionMargin {
  ContactVerdict verdict = ContactVerdict::holds;
  /// (mu F_v - |F_t|) / sqrt(1 + mu^2): the force's distance from the cone's nearer edge, as a
  /// force; < 0 outside. Its deviation is that of the nearer edge.
  Uncertain distance{};
  double used = 0.0;   ///< |F_t| / (mu F_v); infinite where nothing presses; 0 where idle
  double angle = 0.0;  ///< atan mu - |atan2(F_t, F_v)| [rad]; < 0 outside
};

/// What a margin means; all but its verdict is known.
[[nodiscard]] inline ContactVerdict verdict_of(const FrictionMargin& margin, bool idle,
                                               double normal) noexcept {
  if (idle) return ContactVerdict::idle;
  if (!(normal > 0.0)) return ContactVerdict::pulls;
  return margin.distance.value < 0.0 ? ContactVerdict::slips : ContactVerdict::holds;
}

/// @param friction  mu, > 0
[[nodiscard]] inline FrictionMargin friction_margin(const FingerAction& action,
                                                    double friction) noexcept {
  const double size = std::abs(action.tangential);
  const double scale = 1.0 / std::hypot(1.0, friction);
  // The distance is n.(F_v, |F_t|) with n across the edge.
  const double by_normal = friction * scale;
  const double by_tangential = std::copysign(scale, -action.tangential);
  using enum ContactValue;
  const auto& c = action.covariance;
  const double variance =
      by_normal * by_normal * c(normal, normal) +
      by_tangential * by_tangential * c(tangential, tangential) +
      by_normal * by_tangential * (c(normal, tangential) + c(tangential, normal));
  FrictionMargin margin;
  margin.distance = {by_normal * action.normal - scale * size, std::sqrt(std::fmax(variance, 0.0))};
  margin.used = is_idle(action)       ? 0.0
                : action.normal > 0.0 ? size / (friction * action.normal)
                                      : INFINITY;
  margin.angle = std::atan(friction) - std::abs(std::atan2(action.tangential, action.normal));
  margin.verdict = verdict_of(margin, is_idle(action), action.normal);
  return margin;
}

struct TorqueMargin {
  double left = 0.0;  ///< limit - |torque|: what is left; < 0 beyond the limit
  double used = 0.0;  ///< |torque| / limit
};

/// @param limit  > 0
[[nodiscard]] inline TorqueMargin torque_margin(double torque, double limit) noexcept {
  return {limit - std::abs(torque), std::abs(torque) / limit};
}

}  // namespace tactile_net
