#include "tactile_net/skin/direct.hpp"

#include <cmath>
#include <stdexcept>

#include "inverse/checks.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "skin/coordinates.hpp"

namespace tactile_net {

std::vector<double> tikhonov_solve(const SkinProblem& problem, double alpha,
                                   std::span<const double> readings) {
  check_alpha(alpha);
  const std::vector<double> right = weighted(problem, readings);
  if (!all_finite(right)) throw std::invalid_argument("readings must be finite");
  const CosineCoordinates waves(problem, stabiliser_spectrum(problem).cwiseSqrt());
  const Eigen::MatrixXd kernel = waves.sums(as_eigen(problem.kernel).transpose());  // transposed
  const Eigen::Index m = kernel.cols();
  const Eigen::Index n = kernel.rows();
  const Eigen::VectorXd g = as_eigen(std::span(right));
  const double root = std::sqrt(alpha);
  Eigen::VectorXd x;
  if (m < n) {
    Eigen::MatrixXd stacked(n + m, m);
    stacked << kernel, root * Eigen::MatrixXd::Identity(m, m);
    const HouseholderQr qr(stacked);
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n + m);
    z.head(m) = qr.triangle().triangularView<Eigen::Upper>().transpose().solve(g);
    x = qr.rotate_back(z).col(0).head(n);
  } else {
    Eigen::MatrixXd stacked(m + n, n);
    stacked << kernel.transpose(), root * Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd z = Eigen::VectorXd::Zero(m + n);
    z.head(m) = g;
    x = HouseholderQr(stacked).solve(z);
  }
  const Eigen::VectorXd f = waves.tractions(x);
  return {f.begin(), f.end()};
}

}  // namespace tactile_net
