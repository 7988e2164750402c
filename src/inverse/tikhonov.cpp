#include "inverse/checks.hpp"
#include "inverse/stacked.hpp"
#include "tactile_net/inverse/reconstruction.hpp"

namespace tactile_net {
Reconstruction tikhonov(const InverseProblem& problem, double alpha) {
  check_alpha(alpha);
  const auto rows = static_cast<Eigen::Index>(problem.kernel.rows);
  const auto [inverse, condition] = StackedQr(stacked(problem, alpha)).pseudo_inverse(rows);
  return {unweighted(inverse, problem), condition};
}

std::vector<double> tikhonov_solve(const InverseProblem& problem, double alpha,
                                   std::span<const double> readings) {
  check_alpha(alpha);
  check_readings(readings, problem.kernel.rows);
  const Eigen::MatrixXd a = stacked(problem, alpha);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(a.rows());
  right.head(std::ssize(readings)) = Weighting(problem)(readings);
  const StackedQr qr(a);
  (void)qr.condition();  // throws if rank deficient
  const Eigen::VectorXd f = qr.solve_rotated(qr.rotate(right));
  return {f.begin(), f.end()};
}

}  // namespace tactile_net
