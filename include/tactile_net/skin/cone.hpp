/// @file
/// Tikhonov's method on a skin under what contact allows: nothing pulls, and friction has a limit.
///
///     p >= 0     and     |(q_y, q_z)| <= limit p
///
/// A cone of second order in every cell, onto which a projection is known in closed form: solved by
/// alternating directions (ADMM; Boyd and others 2011) with the penalty 2 sqrt(lambda_max alpha)
/// and relaxation 1.6, in the family's classes, factored once for all frames.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/realtime/frame_status.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// In which directions tractions may still change: none where nothing touches, two along the cone
/// where friction is at its limit, all where it is not.
struct ConeFace {
  struct Direction {
    std::size_t cell = 0;
    std::array<double, 3> along{};  ///< of (p, q_y, q_z), of length 1
  };
  std::vector<Direction> free{};
};

/// A face's directions as columns, tractions x directions.
/// @throw std::invalid_argument  a cell is not the problem's
[[nodiscard]] Matrix edges(const SkinProblem& problem, const ConeFace& face);

/// Of one frame. Unless the status is `ok`, nothing else in it is set.
struct SkinConeSolution {
  FrameStatus status = FrameStatus::ok;
  std::vector<double>
      tractions{};  ///< [Pa], as `SkinFamily::solve`; they obey the constraints exactly
  ConstrainedVerdict verdict = ConstrainedVerdict::ok;
  /// |f - proj(f - (P f - b) / lambda_max)| lambda_max / |b|: 0 at the minimum alone.
  double residual = 0.0;
  std::size_t iterations = 0;
  std::size_t apart = 0;     ///< cells at the cone's tip: nothing touches
  std::size_t sliding = 0;   ///< on the cone: friction at its limit
  std::size_t sticking = 0;  ///< inside; without a limit all that touch
  ConeFace face{};
};

/// The alpha for tractions that obey constraints, where a rule chose one without: what pulls and
/// what slips need no smoothing away any more. Half of that of rgcv and aicc, and of the others as
/// it is; measured in docs/internals/skin.md.
[[nodiscard]] double constrained_alpha(AlphaRule rule, double alpha) noexcept;

class SkinCone {
 public:
  /// As a `SkinFamily`.
  ///
  /// @throw std::invalid_argument  alpha is not > 0; friction_limit is not > 0, or there is one
  ///                               component only
  SkinCone(const SkinProblem& problem, double alpha, const Constraints& constraints);
  ~SkinCone();
  SkinCone(SkinCone&&) noexcept;
  SkinCone& operator=(SkinCone&&) noexcept;

  /// The same of another alpha. What does not depend on it is shared, which takes a fraction of the
  /// time; the tractions are those of a cone made anew, to the last bit.
  /// @throw std::invalid_argument  alpha is not > 0 and finite
  [[nodiscard]] SkinCone with_alpha(double alpha) const;

  /// One frame, from 0: some 30 to 300 steps, each the price of two products with K by classes.
  /// Allocates. `too_large` if any weighted reading or traction would not be finite.
  ///
  /// @param iteration_limit  steps after which the best so far is returned
  /// @param enough           residual at which it ends
  [[nodiscard]] SkinConeSolution solve(std::span<const double> readings,
                                       std::size_t iteration_limit = 2000,
                                       double enough = 1e-6) const;

 private:
  struct System;
  explicit SkinCone(std::unique_ptr<const System> system);
  std::unique_ptr<const System> system_;
};

}  // namespace tactile_net
