/// @file
/// Private. One exponential memory, exact for inputs that are straight lines between moments.
#pragma once

namespace tactile_net {

/// One step of tau v' = u - v:
///
///     v(t + dt) = keep v(t) + before u(t) + now u(t + dt),  u a straight line in between
///
/// keep = exp(-dt/tau); the three add up to 1. dt = 0 gives keep = 1: give a jump of u as two
/// samples at the same time.
struct FirstOrderLag {
  double keep = 1.0;
  double before = 0.0;
  double now = 0.0;
};

/// @param dt   [s], >= 0
/// @param tau  time constant [s], > 0
[[nodiscard]] FirstOrderLag first_order_lag(double dt, double tau) noexcept;

}  // namespace tactile_net
