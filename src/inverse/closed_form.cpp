#include "inverse/stacked.hpp"
#include "tactile_net/inverse/reconstruction.hpp"

namespace tactile_net {

Reconstruction closed_form(const InverseProblem& problem, double alpha) {
  check_alpha(alpha);
  const auto kernel = as_eigen(problem.kernel);
  const Eigen::Index m = kernel.rows();
  const Eigen::Index n = kernel.cols();
  const auto block = static_cast<Eigen::Index>(problem.count);
  const auto unknowns = static_cast<Eigen::Index>(problem.unknowns);
  const double size = std::sqrt(alpha);

  // f = G h + E c: G the cumulative sum times D of each block, E one column of ones per block.
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd e = Eigen::MatrixXd::Zero(n, unknowns);
  for (Eigen::Index u = 0; u < unknowns; ++u) {
    g.block(u * block, u * block, block, block)
        .triangularView<Eigen::Lower>()
        .setConstant(problem.pitch);
    e.block(u * block, u, block, 1).setOnes();
  }

  Eigen::MatrixXd of_h(m + 2 * n, n);
  of_h << kernel * g, size * g, size * problem.smoothing_length * Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd of_c(m + 2 * n, unknowns);
  of_c << kernel * e, size * e, Eigen::MatrixXd::Zero(n, unknowns);

  const StackedQr qr(of_h);
  const auto [u, condition] = qr.pseudo_inverse(m);
  // Without smoothing the first entry of h is a constant too, and c is redundant.
  if (problem.smoothing_length == 0.0) return {unweighted(g * u, problem), condition};

  Eigen::MatrixXd rotated = qr.rotate(of_c);
  const Eigen::MatrixXd v = qr.solve_rotated(rotated);
  rotated.topRows(n).setZero();
  const StackedQr residual(qr.rotate_back(rotated));  // r_v, orthogonal to the columns of h
  const Eigen::MatrixXd c = residual.pseudo_inverse(m).first;
  return {unweighted(g * (u - v * c) + e * c, problem), condition};
}

}  // namespace tactile_net
