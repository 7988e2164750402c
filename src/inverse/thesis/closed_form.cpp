#include "tactile_net/inverse/thesis/closed_form.hpp"

#include <algorithm>
#include <cmath>

#include "inverse/checks.hpp"
#include "inverse/stacked.hpp"

namespace tactile_net {

Reconstruction closed_form(const LinearProblem& problem, double alpha,
                           std::optional<double> stacked_condition) {
  check_alpha(alpha);
  const auto kernel = as_eigen(problem.kernel);
  const Eigen::Index m = kernel.rows();
  const Eigen::Index n = kernel.cols();
  const auto block = static_cast<Eigen::Index>(problem.grid.count());
  const auto unknowns = static_cast<Eigen::Index>(problem.components);
  const double size = std::sqrt(alpha * problem.measure);

  // f = G h + E c: E one column of ones per block, G the cumulative sum times h. h is the slope
  // between neighbours: the thesis' slope before the first one acts as c does and is left out.
  const Eigen::Index slopes = n - unknowns;
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n, slopes);
  Eigen::MatrixXd e = Eigen::MatrixXd::Zero(n, unknowns);
  for (Eigen::Index u = 0; u < unknowns; ++u) {
    g.block(u * block + 1, u * (block - 1), block - 1, block - 1)
        .triangularView<Eigen::Lower>()
        .setConstant(problem.grid.spacing_y);
    e.block(u * block, u, block, 1).setOnes();
  }

  const Eigen::VectorXd sizes = std::sqrt(alpha) * stabiliser_sizes(problem);
  Eigen::VectorXd slope_sizes(slopes);
  for (Eigen::Index u = 0; u < unknowns; ++u)
    slope_sizes.segment(u * (block - 1), block - 1)
        .setConstant(size * problem.smoothing_length * stabiliser_weight(problem, u * block));
  Eigen::MatrixXd of_h(m + n + slopes, slopes);
  of_h << kernel * g, sizes.asDiagonal() * g, Eigen::MatrixXd(slope_sizes.asDiagonal());
  Eigen::MatrixXd of_c(of_h.rows(), unknowns);
  of_c << kernel * e, sizes.asDiagonal() * e, Eigen::MatrixXd::Zero(slopes, unknowns);

  const StackedQr qr(of_h);
  const auto [u, condition_of_h] = qr.pseudo_inverse(m);
  if (!stacked_condition) stacked_condition = StackedQr(stacked(problem, alpha)).condition();
  const double condition = std::max(condition_of_h, *stacked_condition);
  Eigen::MatrixXd rotated = qr.rotate(of_c);
  const Eigen::MatrixXd v = qr.solve_rotated(rotated);
  rotated.topRows(slopes).setZero();
  const StackedQr residual(qr.rotate_back(rotated));  // r_v, orthogonal to the columns of h
  const Eigen::MatrixXd c = residual.pseudo_inverse(m).first;
  return {unweighted(g * (u - v * c) + e * c, problem), condition};
}

}  // namespace tactile_net
