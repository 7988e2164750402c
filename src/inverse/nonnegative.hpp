/// @file
/// Non-negative least squares: block principal pivoting (Portugal, Judice and Vicente 1994), and
/// Lawson and Hanson's method where that stalls. Private.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace tactile_net {

struct NonnegativeSolution {
  Eigen::VectorXd z{};
  std::vector<bool> free{};
  double kkt_residual = 0.0;
  std::size_t iterations = 0;
  bool converged = false;
};

/// Minimises |A z - d| with z_i >= 0 where `bounded`. A has full column rank, at least as many rows
/// as columns, and columns of about unit norm.
[[nodiscard]] NonnegativeSolution nonnegative_least_squares(const Eigen::MatrixXd& a,
                                                            const Eigen::VectorXd& d,
                                                            const std::vector<bool>& bounded,
                                                            std::size_t iteration_limit);

}  // namespace tactile_net
