/// @file
/// How far a grasp is from slipping, and from the motors' limits.
#pragma once

#include <cmath>

#include "tactile_net/grasp/finger_action.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/fields.hpp"

namespace tactile_net {

enum class ContactVerdict { holds, idle, slips, pulls };

template <>
struct Enumerators<ContactVerdict> {
  static constexpr Enumerator<ContactVerdict> all[] = {
      {ContactVerdict::holds, "holds", "The force is within the cone of friction."},
      {ContactVerdict::idle, "idle", "There is no force at all."},
      {ContactVerdict::slips, "slips", "The force is outside the cone of friction."},
      {ContactVerdict::pulls, "pulls", "The finger would have to pull."}};
};

[[nodiscard]] inline bool is_idle(const FingerAction& action) noexcept {
  return action.normal == 0.0 && action.tangential == 0.0;
}

[[nodiscard]] constexpr const char* name(ContactVerdict verdict) noexcept {
  return enumerator_name(verdict).data();  // a literal, which ends with a zero
}

struct FrictionMargin {
  ContactVerdict verdict = ContactVerdict::holds;
  /// (mu F_v - |F_t|) / sqrt(1 + mu^2): the force's distance from the cone's nearer edge, as a
  /// force; < 0 outside. Its deviation is that of the nearer edge.
  Uncertain distance{};
  double used = 0.0;   ///< |F_t| / (mu F_v); infinite where nothing presses; 0 where idle
  double angle = 0.0;  ///< atan mu - |atan2(F_t, F_v)| [rad]; < 0 outside
};

/// A force beyond its cone by less than this, relative to the forces, counts as on the edge: it
/// holds by all of its friction.
inline constexpr double edge_rounding = 1e-12;

/// How far a contact force is from slipping.
/// @param slipping   |F_t|, and whatever else counts against friction, as a force
/// @param deviation  of mu F_v - slipping
/// @param friction   mu, > 0
[[nodiscard]] inline FrictionMargin friction_margin(double normal, double slipping,
                                                    double deviation, double friction) noexcept {
  const bool idle = normal == 0.0 && slipping == 0.0;
  const double scale = 1.0 / std::hypot(1.0, friction);
  double left = friction * normal - slipping;
  if (left < 0.0 && left > -edge_rounding * slipping) left = 0.0;
  FrictionMargin margin;
  margin.distance = {scale * left, scale * deviation};
  margin.used = idle ? 0.0 : normal > 0.0 ? slipping / (friction * normal) : INFINITY;
  margin.angle = std::atan(friction) - std::atan2(slipping, normal);
  margin.verdict = idle              ? ContactVerdict::idle
                   : !(normal > 0.0) ? ContactVerdict::pulls
                   : left < 0.0      ? ContactVerdict::slips
                                     : ContactVerdict::holds;
  return margin;
}

/// @param friction  mu, > 0
[[nodiscard]] inline FrictionMargin friction_margin(const FingerAction& action,
                                                    double friction) noexcept {
  using enum ContactValue;
  const auto& c = action.covariance;
  const double across = std::copysign(1.0, action.tangential);
  const double variance = friction * friction * c(normal, normal) + c(tangential, tangential) -
                          across * friction * (c(normal, tangential) + c(tangential, normal));
  return friction_margin(action.normal, std::abs(action.tangential),
                         std::sqrt(std::fmax(variance, 0.0)), friction);
}

/// How far a torque is from its motor's limit.
struct TorqueMargin {
  double left = 0.0;  ///< limit - |torque|: what is left; < 0 beyond the limit
  double used = 0.0;  ///< |torque| / limit
};

/// @param limit  > 0
[[nodiscard]] inline TorqueMargin torque_margin(double torque, double limit) noexcept {
  return {limit - std::abs(torque), std::abs(torque) / limit};
}

}  // namespace tactile_net
