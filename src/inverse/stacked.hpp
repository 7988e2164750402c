/// @file
/// Least squares of stacked matrices by QR, shared by `tikhonov` and `closed_form`. Private.
#pragma once

#include <cmath>
#include <utility>

#include "inverse/line_stabiliser.hpp"
#include "inverse/weighting.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// [W K; sqrt(alpha) L].
[[nodiscard]] inline Eigen::MatrixXd stacked(const LinearProblem& problem, double alpha) {
  const auto kernel = as_eigen(problem.kernel);
  Eigen::MatrixXd a(kernel.rows() + 2 * kernel.cols(), kernel.cols());
  a.topRows(kernel.rows()) = kernel;
  a.bottomRows(2 * kernel.cols()) = std::sqrt(alpha) * stabiliser(problem);
  return a;
}

/// QR of a tall matrix, its rows taken largest first: Householder reflections are then stable row
/// by row, however far apart alpha sets them (Cox and Higham 1998; Bjorck 1996, 4.4.2).
class StackedQr {
 public:
  explicit StackedQr(const Eigen::MatrixXd& stacked);

  [[nodiscard]] Eigen::Index unknowns() const noexcept { return factors_.columns(); }

  /// Q' x, of full length: the first `unknowns()` entries solve, the rest is the residual.
  [[nodiscard]] Eigen::MatrixXd rotate(const Eigen::MatrixXd& right) const;

  /// Q x for x of full length.
  [[nodiscard]] Eigen::MatrixXd rotate_back(const Eigen::MatrixXd& x) const;

  /// R.
  [[nodiscard]] Eigen::MatrixXd triangle() const { return factors_.triangle(); }

  /// The least-squares solution for a rotated right side.
  [[nodiscard]] Eigen::MatrixXd solve_rotated(const Eigen::MatrixXd& rotated) const;

  /// 2-norm condition number.
  /// @throw std::domain_error  it exceeds what double precision can resolve
  [[nodiscard]] double condition() const;

  /// The first `rows` columns of the pseudo-inverse, and the condition number.
  ///
  /// By a singular value decomposition of the triangle. Solving with the triangle would give each
  /// column an error of kappa times its own size, kappa^2 in all: here the factors' errors stay
  /// orthogonal to it, and a product with readings loses kappa alone.
  ///
  /// @throw std::domain_error  as `condition`
  [[nodiscard]] std::pair<Eigen::MatrixXd, double> pseudo_inverse(Eigen::Index rows) const;

 private:
  [[nodiscard]] double checked_condition(const Eigen::VectorXd& singular_values) const;

  Eigen::PermutationMatrix<Eigen::Dynamic> sorted_;
  HouseholderQr factors_;
};

/// M P W: a pseudo-inverse of weighted rows, applied to readings as they are.
[[nodiscard]] inline Matrix unweighted(const Eigen::MatrixXd& inverse,
                                       const LinearProblem& problem) {
  return from_eigen(Weighting(problem).applied(inverse));
}

}  // namespace tactile_net
