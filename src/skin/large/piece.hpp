/// @file
/// A smaller skin of the same taxels, which stands for a large one where only what lies within a
/// few depths counts: the deviations of single tractions. Private.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// A cell of the large skin has the deviation of the piece's cell that is as far from the nearest
/// ends. Around a dead taxel deviations are multiplied by what a dead taxel in the piece's middle
/// multiplies them by, around several by all of theirs, up to the prior's, which is what a cell has
/// whose nearest taxel is dead with all around it. Within 4 % of the exact ones for alpha >= 1e-4
/// of |W K|^2 and 10 % at 1e-6 but for such blocks: too wide inside, at the rim up to a sixth too
/// narrow (large_test.cpp).
class SkinPiece {
 public:
  /// @param whole  the large skin's, of the same taxels and options; its dead ones do not count
  SkinPiece(const SkinArray& skin, const Material& material, const SkinProblemOptions& options,
            const LinearProblem& whole);

  /// Of every traction of the whole [Pa per unit of noise].
  ///
  /// @param whole  as the constructor's, with any taxels dead
  [[nodiscard]] std::vector<double> deviations(const LinearProblem& whole, double alpha,
                                               double prior_alpha);

  /// Of the sums of normal tractions in the window around each cell of the whole. A window that
  /// holds a dead taxel's cell has at least the prior's.
  [[nodiscard]] std::vector<double> window_deviations(const LinearProblem& whole, double alpha,
                                                      double prior_alpha,
                                                      const CellWindow& window) const;

  /// Of a sum over the tractions of one cell, as if no taxel were dead.
  ///
  /// @param weights  one per component
  [[nodiscard]] double deviation(const LinearProblem& whole, double alpha, double prior_alpha,
                                 std::size_t cell, std::span<const double> weights) const;

  /// Of the largest singular value: what alphas are beside.
  [[nodiscard]] double largest_square() const;

 private:
  /// Where a cell's like is among the piece's.
  [[nodiscard]] std::size_t like_cell(const SurfaceGrid& whole, std::size_t cell) const;
  void add_dead(std::vector<double>& deviations, const std::vector<double>& alive,
                const LinearProblem& whole, double alpha, double prior_alpha);

  SkinArray skin_;
  LinearProblem problem_;
  TikhonovFamily family_;
  std::optional<TikhonovFamily> with_dead_{};  // its middle taxel; made where it is first needed
  Eigen::VectorXd prior_squares_;              // variances of the prior times its alpha
};

}  // namespace tactile_net
