/// @file
/// What a plan holds so that its frames obey what contact allows: nothing pulls, and friction has
/// a limit. A linear frame f0 is followed by a fixed number of steps towards f*, the tractions in
///
///     C = {p >= 0, |q| <= limit p in every cell}
///
/// that are nearest to f0 as the readings see it, in the norm of P = K'W^2 K + alpha L'L: the
/// minimum of Tikhonov's functional inside C. With rho > 0 and S = rho (P + rho)^-1 a step is
///
///     z = the point of C next to v              closed, cell by cell
///     x = f0 + S (2 z - v - f0)                 one product, in single precision
///     v <- v + 1.6 (x - z), accelerated         (Anderson 1965; 5 pairs of this frame)
///
/// from v = f0. Whatever v is, |z - f*|_P <= kappa |z - x|, with kappa the largest of
/// (w + rho) / sqrt(w) among the eigenvalues w of P: z and z + P^-1 rho (z - v) see f* under a
/// right angle or more (Prager and Synge 1947; docs/internals/cone.md has the proof). So a frame
/// says of itself how far from f* it stopped, rounding included, and does not rely on convergence.
#pragma once

#include <cstddef>
#include <optional>

#include "tactile_net/realtime/product_plan.hpp"

namespace tactile_net {

/// How far frames are from their minimum, of those that a planner drew: in the unit of
/// `ContactEstimate::unfinished`, or where the plan has no noise of `unfinished_share`.
struct ExpectedUnfinished {
  double median = 0.0;
  double high = 0.0;  ///< 99.9 % of the frames are nearer
  double worst = 0.0;
};

/// Made by `plan_estimator` (control/planner.hpp).
struct ConePlan {
  static constexpr std::size_t most_steps = 64;

  std::optional<double> friction_limit{};  ///< > 0; needs tangential tractions. Absent: p >= 0
  std::size_t steps = 0;                   ///< of a frame, 1 to `most_steps`
  /// Of tangential tractions: times it they are all as likely as normal ones, and P is of these.
  double tangential_scale = 1.0;
  ProductPlan step{};  ///< S, of tractions so scaled, in float32
  double bound = 0.0;  ///< kappa, of weighted readings over tractions so scaled, > 0
  /// Bound of what `step` errs by, rounding included, in the 2-norm over that of what it
  /// multiplies.
  double rounding = 0.0;
  /// True if channels have constants that nobody knows, which the prediction explains.
  bool unknown_offsets = false;
  ExpectedUnfinished expected{};
};

/// How much a frame may do; `ContactEstimator::set_work`.
struct ConeWork {
  std::size_t steps = 0;  ///< at most; 0: the plan's
  /// A frame ends with the step whose `unfinished` is at most this; 0: it takes all its steps, and
  /// equal work for every frame.
  double enough = 0.0;
};

/// @throw std::invalid_argument  a value is out of its range, or not one of `unknowns` tractions of
///                               `values` each
void check(const ConePlan& cone, std::size_t unknowns, std::size_t values);

}  // namespace tactile_net
