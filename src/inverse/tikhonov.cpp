#include "inverse/checks.hpp"
#include "inverse/coordinates.hpp"
#include "inverse/stacked.hpp"
#include "tactile_net/inverse/reconstruction.hpp"

namespace tactile_net {
namespace {

/// By a QR of A = [W K T; sqrt(alpha) I] with f = T z, or where there are fewer readings than
/// tractions as the shortest x with [W K T, sqrt(alpha) I] x = P W g, by a QR of its transposed.
std::vector<double> solved_in_waves(const LinearProblem& problem, double alpha,
                                    const Eigen::VectorXd& g) {
  const WaveCoordinates waves(problem, stabiliser_spectrum(problem).cwiseSqrt());
  const Eigen::MatrixXd kernel = waves.sums(as_eigen(problem.kernel).transpose());  // transposed
  const Eigen::Index m = kernel.cols();
  const Eigen::Index n = kernel.rows();
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

}  // namespace

Reconstruction tikhonov(const LinearProblem& problem, double alpha) {
  check_alpha(alpha);
  const auto rows = static_cast<Eigen::Index>(problem.kernel.rows);
  const auto [inverse, condition] = StackedQr(stacked(problem, alpha)).pseudo_inverse(rows);
  return {unweighted(inverse, problem), condition};
}

std::vector<double> tikhonov_solve(const LinearProblem& problem, double alpha,
                                   std::span<const double> readings) {
  check_alpha(alpha);
  check_readings(readings, problem.kernel.rows);
  const Eigen::VectorXd g = Weighting(problem)(readings);
  if (!problem.is_line) return solved_in_waves(problem, alpha, g);
  const Eigen::MatrixXd a = stacked(problem, alpha);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(a.rows());
  right.head(g.size()) = g;
  const StackedQr qr(a);
  (void)qr.condition();  // throws if rank deficient
  const Eigen::VectorXd f = qr.solve_rotated(qr.rotate(right));
  return {f.begin(), f.end()};
}

}  // namespace tactile_net
