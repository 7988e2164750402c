#include "tactile_net/inverse/error_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "inverse/checks.hpp"
#include "inverse/line_stabiliser.hpp"
#include "inverse/rounding.hpp"
#include "inverse/weighting.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {

double wedin_bound(double condition, double matrix_norm, double right_norm, double residual_norm,
                   double solution_norm, double perturbation) noexcept {
  if (right_norm == 0.0) return 0.0;
  if (!(solution_norm > 0.0)) return std::numeric_limits<double>::infinity();
  const double size = matrix_norm * solution_norm;
  return perturbation *
         (condition * (1.0 + right_norm / size + condition * residual_norm / size) + 1.0);
}

void require_full_rank(double condition, std::size_t rows) {
  const double limit = 1.0 / (std::numeric_limits<double>::epsilon() * static_cast<double>(rows));
  if (!(condition < limit))
    throw std::domain_error("rank deficient in double precision: condition number " +
                            brief(condition, 6) + " of the stacked matrix, limit " +
                            brief(limit, 6) + "; raise alpha");
}

double forward_bound(const LinearProblem& problem, double alpha, std::span<const double> readings,
                     std::span<const double> tractions, double condition) {
  check_size(readings, problem.weights.size());
  check_tractions(tractions, problem.kernel.columns);
  const auto kernel = as_eigen(problem.kernel);
  const Eigen::VectorXd g = Weighting(problem)(readings);
  const double scale = g.size() > 0 ? g.cwiseAbs().maxCoeff() : 0.0;
  if (scale == 0.0) return 0.0;

  // Scaled, so that no square leaves the range of a double.
  const Eigen::VectorXd f = as_eigen(tractions) / scale;
  const Eigen::VectorXd right = g / scale;
  const double smoothness = alpha * stabiliser_square(problem, f);
  const double residual = std::sqrt((kernel * f - right).squaredNorm() + smoothness);

  // |A|_2 lies between the root of the mean and the root of the sum of its squared entries; from
  // below the bound stays one. |A|_2 >= the norm of the stabiliser, and >= |K x| for any unit x.
  const double ratio = problem.smoothing_length / problem.grid.spacing_y;
  const double heavier = std::max(1.0, stabiliser_weight(problem, kernel.cols() - 1));
  const double stabiliser =
      heavier * std::sqrt(alpha * problem.measure * (1.0 + 2.0 * ratio * ratio));
  Eigen::VectorXd x = Eigen::VectorXd::Constant(kernel.cols(), 1.0);
  x /= x.norm();
  double response = 0.0;
  for (int step = 0; step < 4; ++step) {
    const Eigen::VectorXd y = kernel * x;
    response = y.norm();
    if (response == 0.0) break;
    x = (kernel.transpose() * (y / response)).normalized();
  }
  const double rounding = std::numeric_limits<double>::epsilon() / 2.0 *
                          std::sqrt(static_cast<double>(kernel.rows() + 2 * kernel.cols()));
  const double underflow =
      underflow_error(static_cast<std::size_t>(kernel.rows() + kernel.cols()), scale);
  const double size = std::max(response, stabiliser);
  return wedin_bound(condition, size, right.norm(), residual, f.norm(),
                     problem.kernel_error / size + rounding + underflow) +
         underflow / f.norm();
}

}  // namespace tactile_net
