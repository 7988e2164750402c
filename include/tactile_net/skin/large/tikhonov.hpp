/// @file
/// The tractions of a large skin, by FFT and conjugate gradients (target tactile_net::spectral).
///
/// The minimiser of inverse/linear_problem.hpp without its matrix, boundaries and dead taxels
/// included: conjugate gradients on the stacked matrix [W K; sqrt(alpha) L] (CGLS: P is never
/// formed), each product O(cells log cells), preconditioned by overlapping tiles of 16 x 16 to 24 x
/// 24 cells, and where those are slow by a coarse space too: some 30 steps where a circulant
/// inverse takes hundreds (docs/internals/skin.md). A step takes a product with K, one with its
/// transposed, and a solve for each tile; with the coarse space four products instead of two.
/// Taxels lie on the lattice of the cells, and offsets are known.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/realtime/frame_status.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/large/system.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// How the iteration for one frame ended.
struct SkinConvergence {
  std::size_t steps = 0;
  double residual = 0.0;  ///< |P f - b| / |b|
  /// Proven bound of |error|_2 / |f|_2: |P f - b| / (lambda |f|), with the least eigenvalue lambda
  /// of alpha L'L for that of P.
  double bound = 0.0;
  /// Estimate of |error|_2 / |f|_2 of the iterate four steps back (Hestenes and Stiefel 1952,
  /// section 6); the answer returned is better.
  double estimate = 0.0;
  bool converged = true;  ///< `estimate` or `bound` reached the tolerance
};

class LargeSkinTikhonov {
 public:
  /// Transforms the kernels and factors the tiles. O(cells log cells), and one decomposition of
  /// 768 to 1728 unknowns for each kind of tile: four of a skin whose tiles fit. A coarse space is
  /// made below 1e-7 of the square of what uniform pressure reads, below 1e-3 where there are
  /// several cells to a taxel, and for every alpha where a uniform drag is hardly seen, as by
  /// stresses in the plane: once some 1.2 products for each cell along the longer side, four times
  /// as many where taxels are dead, and in the last case 12 to 96 steps for each alpha.
  ///
  /// @param alpha  > 0
  /// @throw std::invalid_argument  as `make_problem`, but for the kernel's size; alpha is not > 0
  ///                               and finite, or so small that a double cannot tell the tractions
  ///                               apart; offsets are unknown; the taxels do not lie on the cells'
  ///                               lattice
  LargeSkinTikhonov(const SkinArray& skin, const Material& material,
                    const SkinProblemOptions& options, double alpha);
  /// @throw std::invalid_argument  alpha is not > 0 and finite, or so small that a double cannot
  ///                               tell the tractions apart
  LargeSkinTikhonov(std::shared_ptr<LargeSkinSystem> system, double alpha);
  ~LargeSkinTikhonov();
  LargeSkinTikhonov(LargeSkinTikhonov&&) noexcept;
  LargeSkinTikhonov& operator=(LargeSkinTikhonov&&) noexcept;

  /// Takes another alpha for the frames to come: the tiles are factored anew, the
  /// coarse space keeps its waves.
  /// @throw std::invalid_argument  as the constructor
  void use_alpha(double alpha);
  [[nodiscard]] double alpha() const noexcept;

  /// The solver's problem, without the kernel, which is empty.
  [[nodiscard]] const LinearProblem& problem() const noexcept;

  /// One frame. Uses buffers of its own: one object per thread.
  ///
  /// @param readings    one value per reading
  /// @param tractions   f [Pa], components x cells; untouched unless the status is `ok`
  /// @param tolerance   wanted |error|_2 / |f|_2 against the exact minimiser, > 0
  /// @param step_limit  after which the best so far is returned, with `converged` false
  /// @return            `too_large` if any weighted reading or traction would not be finite
  FrameStatus solve(std::span<const double> readings, std::span<double> tractions,
                    double tolerance = 1e-8, std::size_t step_limit = 500);

  /// b = (WK)' W g: `solve_normal` of it is what `solve` finds.
  /// @pre  there is one value per reading
  [[nodiscard]] std::vector<double> normal_right_side(std::span<const double> readings);

  /// P^-1 times `right`, until |P x - right| <= residual |right|, or 500 steps.
  /// @pre  right has one value per traction
  [[nodiscard]] std::vector<double> solve_normal(std::span<const double> right,
                                                 double residual = 1e-8);

  /// [W K; sqrt(alpha) L] times tractions: `stacked_rows()` values, the weighted readings, then the
  /// smoothness terms. @pre  there is one value per traction
  [[nodiscard]] std::vector<double> stacked_product(std::span<const double> tractions);
  [[nodiscard]] std::size_t stacked_rows() const noexcept;

  /// How the last `solve` or `solve_normal` ended.
  [[nodiscard]] const SkinConvergence& convergence() const noexcept;

  /// The products, which families share; their buffers are for one thread.
  [[nodiscard]] std::shared_ptr<LargeSkinSystem> system() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tactile_net
