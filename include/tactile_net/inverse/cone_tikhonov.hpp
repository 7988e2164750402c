/// @file
/// Tikhonov's method for tractions in three directions, a skin's, under what contact allows:
/// nothing pulls, and friction has a limit.
///
///     p >= 0     and     |(q_y, q_z)| <= limit p
///
/// A second-order cone in every cell, onto which the projection is known in closed form: solved by
/// alternating directions (ADMM; Boyd and others 2011) with the penalty 2 sqrt(lambda_max alpha)
/// and relaxation 1.6, accelerated by Anderson's method, in the family's classes, factored once for
/// all frames. A controller takes the same steps, a fixed number of them: realtime/cone_plan.hpp.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/active_face.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/realtime/frame_status.hpp"

namespace tactile_net {

/// The answer to one frame. Unless the status is `ok`, no other member is set.
struct ConeSolution {
  FrameStatus status = FrameStatus::ok;
  /// [Pa], in the order of `TikhonovFamily::solve`; they obey the constraints exactly.
  std::vector<double> tractions{};
  ConstrainedVerdict verdict = ConstrainedVerdict::ok;
  /// |f - proj(f - (P f - b) / lambda_max)| lambda_max / |b|: 0 at the minimum alone.
  double residual = 0.0;
  std::size_t iterations = 0;
  std::size_t separation = 0;  ///< number of cells where nothing touches: the cone's tip
  std::size_t slip = 0;        ///< number of cells with friction at its limit: on the cone
  std::size_t stick = 0;       ///< number of cells inside the cone; without a limit all that touch
  ActiveFace face{};
};

/// The alpha to solve with under constraints, from the alpha that a rule chose without them. The
/// constraints already suppress pulling and slip, so less smoothing is needed: half the alpha of
/// rgcv and aicc; the alpha of other rules stays. Measured in docs/internals/skin.md.
[[nodiscard]] double constrained_alpha(AlphaRule rule, double alpha) noexcept;

class ConeTikhonov {
 public:
  /// Factors the problem, at the cost of a `TikhonovFamily`.
  ///
  /// @throw std::invalid_argument  alpha is not > 0; friction_limit is not > 0, or there is one
  ///                               component only
  ConeTikhonov(const LinearProblem& problem, double alpha, const Constraints& constraints);
  ~ConeTikhonov();
  ConeTikhonov(ConeTikhonov&&) noexcept;
  ConeTikhonov& operator=(ConeTikhonov&&) noexcept;

  /// The same problem and constraints with another alpha. Shares what does not depend on alpha,
  /// which takes a fraction of the time; the tractions have the same bits as those of a new
  /// `ConeTikhonov`.
  /// @throw std::invalid_argument  alpha is not > 0 and finite
  [[nodiscard]] ConeTikhonov with_alpha(double alpha) const;

  /// Called after 25, 50, 100, 200 ... steps with the tractions found so far [Pa], which obey the
  /// constraints, and their number; true: stop, more steps are not needed or in vain.
  using EarlyStop = std::function<bool(std::span<const double> tractions, std::size_t steps)>;

  /// One frame, starting from 0: some 15 to 100 steps, each the price of two products with K by
  /// classes. Allocates. `too_large` if any weighted reading or traction would not be finite.
  ///
  /// @param iteration_limit  steps after which the best so far is returned
  /// @param enough           `ConeSolution::residual` at which the iteration ends
  /// @param stop_early       absent: never; where it stops the verdict is `iteration_limit`
  [[nodiscard]] ConeSolution solve(std::span<const double> readings,
                                   std::size_t iteration_limit = 2000, double enough = 1e-6,
                                   const EarlyStop& stop_early = {}) const;

 private:
  struct System;
  explicit ConeTikhonov(std::unique_ptr<const System> system);
  std::unique_ptr<const System> system_;
};

}  // namespace tactile_net
