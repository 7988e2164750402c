/// @file
/// Private. Conjugate gradients (Hestenes and Stiefel 1952), preconditioned: one loop for every
/// system, which says itself how it multiplies, how it sums, and when it has enough.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace tactile_net {

/// Sums term after term, so that the bits do not depend on an instruction set.
[[nodiscard]] inline double dot_in_order(std::span<const double> a,
                                         std::span<const double> b) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// y += factor x
inline void add_multiple(std::span<double> y, double factor, std::span<const double> x) noexcept {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += factor * x[i];
}

/// Of one size, owned by the caller.
struct GradientBuffers {
  std::span<double> x;                          ///< where the steps begin, and the answer
  std::span<double> gradient;                   ///< b - P x of that x, and of the answer
  std::span<double> preconditioned, direction;  ///< overwritten
};

/// P x = b for a symmetric positive definite P, at most `step_limit` steps. It ends sooner where
/// nothing is left to gain.
///
/// @param curvature     () -> d'P d of the direction d; an image of d that it keeps is `follow`'s
/// @param follow        (step): brings `gradient` to x, which has just gone by `step` times d
/// @param precondition  (gradient, z): z is the gradient times an approximation of P's inverse
/// @param dot           (gradient, z) -> their scalar product, in the order that the caller sums
/// @param done          (steps, gain) -> whether to stop; `gain` is by how much the last step
///                      lowered the square of the error in the norm of P
/// @return  where `done` ended it, `dot` before the last step; where `step_limit` did, or a `dot`
///          that is not > 0, the last one; NaN where a step would not be finite, and is not made
double conjugate_gradients(const GradientBuffers& b, std::size_t step_limit, auto&& curvature,
                           auto&& follow, auto&& precondition, auto&& dot, auto&& done) {
  precondition(b.gradient, b.preconditioned);
  std::copy(b.preconditioned.begin(), b.preconditioned.end(), b.direction.begin());
  double power = dot(b.gradient, b.preconditioned);
  for (std::size_t steps = 0; steps < step_limit && power > 0.0;) {
    const double step = power / curvature();
    if (!std::isfinite(step)) return std::numeric_limits<double>::quiet_NaN();
    add_multiple(b.x, step, b.direction);
    follow(step);
    if (done(++steps, step * power)) break;
    precondition(b.gradient, b.preconditioned);
    const double next = dot(b.gradient, b.preconditioned);
    const double turn = next / power;
    for (std::size_t i = 0; i < b.direction.size(); ++i)
      b.direction[i] = b.preconditioned[i] + turn * b.direction[i];
    power = next;
  }
  return power;
}

/// As `conjugate_gradients` takes it, for a system without a preconditioner.
inline constexpr auto not_preconditioned = [](std::span<const double> gradient,
                                              std::span<double> z) noexcept {
  std::copy(gradient.begin(), gradient.end(), z.begin());
};

}  // namespace tactile_net
