/// @file
/// The stabiliser of problem.hpp, L'L = h/D (l^2/h^2 Q + I). Private.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "numeric/eigen.hpp"
#include "tactile_net/inverse/problem.hpp"

namespace tactile_net {

/// What the size of each value of one traction counts for in L. Hats fall to 0 beyond the first and
/// the last one: these slopes are values' own, too.
[[nodiscard]] inline Eigen::VectorXd stabiliser_sizes(const InverseProblem& problem) {
  const Surface& surface = problem.surface;
  const double size = std::sqrt(surface.area);
  Eigen::VectorXd sizes = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(surface.count), size);
  if (surface.basis == SurfaceBasis::hats)
    sizes(0) = sizes(sizes.size() - 1) =
        size * std::hypot(1.0, problem.smoothing_length / surface.spacing);
  return sizes;
}

/// L itself, [sqrt(h/D) l/h differences; diagonal of sizes], 2 n x n.
[[nodiscard]] inline Eigen::MatrixXd stabiliser(const InverseProblem& problem) {
  const auto n = static_cast<Eigen::Index>(problem.kernel.columns);
  const auto block = static_cast<Eigen::Index>(problem.surface.count);
  const Eigen::VectorXd sizes = stabiliser_sizes(problem);
  const double slope =
      std::sqrt(problem.surface.area) * problem.smoothing_length / problem.surface.spacing;
  Eigen::MatrixXd l = Eigen::MatrixXd::Zero(2 * n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    l(n + i, i) = sizes(i % block);
    if (i % block + 1 == block) continue;  // the last point of a block has no right neighbour
    l(i, i) = -slope;
    l(i, i + 1) = slope;
  }
  return l;
}

/// The triangle R of L's QR, upper bidiagonal: R'R = L'L. Its pivots are sums of positive numbers,
/// so that the squares lose nothing.
[[nodiscard]] inline Eigen::MatrixXd stabiliser_triangle(const InverseProblem& problem) {
  const auto n = static_cast<Eigen::Index>(problem.kernel.columns);
  const auto block = static_cast<Eigen::Index>(problem.surface.count);
  const double ratio = problem.smoothing_length / problem.surface.spacing;
  const double coupling = problem.surface.area * ratio * ratio;
  const Eigen::VectorXd sizes = stabiliser_sizes(problem);
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(n, n);
  double passed_on = 0.0;  // by elimination, from the left neighbour
  for (Eigen::Index i = 0; i < n; ++i) {
    const double own = sizes(i % block) * sizes(i % block) + passed_on;
    const bool last = i % block + 1 == block;
    const double pivot = last ? own : own + coupling;
    r(i, i) = std::sqrt(pivot);
    passed_on = last ? 0.0 : coupling * (own / pivot);
    if (!last) r(i, i + 1) = -coupling / r(i, i);
  }
  return r;
}

/// |L f|_2^2.
[[nodiscard]] inline double stabiliser_square(const InverseProblem& problem,
                                              const Eigen::Ref<const Eigen::VectorXd>& f) {
  const double ratio = problem.smoothing_length / problem.surface.spacing;
  const double coupling = problem.surface.area * ratio * ratio;
  const Eigen::VectorXd sizes = stabiliser_sizes(problem);
  const Eigen::Index n = sizes.size();
  double sum = 0.0;
  for (Eigen::Index start = 0; start < f.size(); start += n)
    sum += sizes.cwiseProduct(f.segment(start, n)).squaredNorm() +
           coupling * (f.segment(start + 1, n - 1) - f.segment(start, n - 1)).squaredNorm();
  return sum;
}

}  // namespace tactile_net
