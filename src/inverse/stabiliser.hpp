/// @file
/// The stabiliser of problem.hpp, L'L = h/D (l^2/h^2 Q + I). Private.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "numeric/eigen.hpp"
#include "tactile_net/inverse/problem.hpp"

namespace tactile_net {

/// L itself, sqrt(h/D) [l/h differences; I], 2 n x n.
[[nodiscard]] inline Eigen::MatrixXd stabiliser(const InverseProblem& problem) {
  const auto n = static_cast<Eigen::Index>(problem.kernel.columns);
  const auto block = static_cast<Eigen::Index>(problem.surface.count);
  const double size = std::sqrt(problem.surface.area);
  const double slope = size * problem.smoothing_length / problem.surface.spacing;
  Eigen::MatrixXd l = Eigen::MatrixXd::Zero(2 * n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    l(n + i, i) = size;
    if (i % block + 1 == block) continue;  // the last point of a block has no right neighbour
    l(i, i) = -slope;
    l(i, i + 1) = slope;
  }
  return l;
}

/// |L f|_2^2.
[[nodiscard]] inline double stabiliser_square(const InverseProblem& problem,
                                              const Eigen::Ref<const Eigen::VectorXd>& f) {
  const double ratio = problem.smoothing_length / problem.surface.spacing;
  const auto n = static_cast<Eigen::Index>(problem.surface.count);
  double sum = f.squaredNorm();
  for (Eigen::Index start = 0; start < f.size(); start += n)
    sum += ratio * ratio * (f.segment(start + 1, n - 1) - f.segment(start, n - 1)).squaredNorm();
  return problem.surface.area * sum;
}

}  // namespace tactile_net
