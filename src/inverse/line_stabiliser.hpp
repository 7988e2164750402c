/// @file
/// The stabiliser of linear_problem.hpp on a line's grid of one column: of each traction
/// L'L = m (l^2/h^2 Q + I), bidiagonal. Private.
#pragma once

#include <cmath>
#include <cstddef>

#include "inverse/checks.hpp"
#include "inverse/stabiliser_weight.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// What L of the traction that column i of K belongs to is multiplied by.
[[nodiscard]] inline double stabiliser_weight(const LinearProblem& problem, Eigen::Index i) {
  const auto component = static_cast<std::size_t>(i) / problem.grid.rows;
  return stabiliser_weight(component, problem.tangential_weight);
}

/// What the size of each value counts for in L. Hats fall to 0 beyond the first and the last one
/// of a traction: these slopes are values' own, too.
[[nodiscard]] inline Eigen::VectorXd stabiliser_sizes(const LinearProblem& problem) {
  require_line(problem);
  const auto block = static_cast<Eigen::Index>(problem.grid.rows);
  const double size = std::sqrt(problem.measure);
  const double end = problem.grid.boundary_y == Boundary::zero_beyond
                         ? size * std::hypot(1.0, problem.smoothing_length / problem.grid.spacing_y)
                         : size;
  Eigen::VectorXd sizes(static_cast<Eigen::Index>(problem.kernel.columns));
  for (Eigen::Index i = 0; i < sizes.size(); ++i) {
    const bool is_end = i % block == 0 || i % block + 1 == block;
    sizes(i) = (is_end ? end : size) * stabiliser_weight(problem, i);
  }
  return sizes;
}

/// What the slope from each value to its right neighbour counts for in L; 0 for the last value of
/// a traction, which has none.
[[nodiscard]] inline Eigen::VectorXd stabiliser_slopes(const LinearProblem& problem) {
  require_line(problem);
  const auto block = static_cast<Eigen::Index>(problem.grid.rows);
  const double slope =
      std::sqrt(problem.measure) * problem.smoothing_length / problem.grid.spacing_y;
  Eigen::VectorXd slopes(static_cast<Eigen::Index>(problem.kernel.columns));
  for (Eigen::Index i = 0; i < slopes.size(); ++i)
    slopes(i) = i % block + 1 == block ? 0.0 : slope * stabiliser_weight(problem, i);
  return slopes;
}

/// L itself, [slopes; diagonal of sizes], 2 n x n.
[[nodiscard]] inline Eigen::MatrixXd stabiliser(const LinearProblem& problem) {
  const auto n = static_cast<Eigen::Index>(problem.kernel.columns);
  const Eigen::VectorXd sizes = stabiliser_sizes(problem);
  const Eigen::VectorXd slopes = stabiliser_slopes(problem);
  Eigen::MatrixXd l = Eigen::MatrixXd::Zero(2 * n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    l(n + i, i) = sizes(i);
    if (slopes(i) == 0.0) continue;
    l(i, i) = -slopes(i);
    l(i, i + 1) = slopes(i);
  }
  return l;
}

/// |L f|_2^2.
[[nodiscard]] inline double stabiliser_square(const LinearProblem& problem,
                                              const Eigen::Ref<const Eigen::VectorXd>& f) {
  const Eigen::VectorXd sizes = stabiliser_sizes(problem);
  const Eigen::VectorXd slopes = stabiliser_slopes(problem);
  const auto n = static_cast<Eigen::Index>(problem.grid.rows);
  double sum = 0.0;
  for (Eigen::Index start = 0; start < f.size(); start += n)
    sum += sizes.segment(start, n).cwiseProduct(f.segment(start, n)).squaredNorm() +
           slopes(start) * slopes(start) *
               (f.segment(start + 1, n - 1) - f.segment(start, n - 1)).squaredNorm();
  return sum;
}

}  // namespace tactile_net
