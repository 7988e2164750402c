#include "grasp/chi_squared.hpp"

#include "numeric/cholesky.hpp"

namespace tactile_net {

std::optional<double> chi_squared(const Eigen::VectorXd& rest, const Eigen::MatrixXd& c) {
  const Eigen::VectorXd scale = c.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (!(scale.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  const Cholesky root(inverse.asDiagonal() * c * inverse.asDiagonal());
  if (!root.is_positive_definite() || root.reciprocal_condition() < 1e-12) return std::nullopt;
  return root.solve_lower(inverse.cwiseProduct(rest)).squaredNorm();
}

}  // namespace tactile_net
