/// @file
/// Non-negative least squares: block principal pivoting (Portugal, Judice and Vicente 1994), and
/// Lawson and Hanson's method where that stalls. Private.
#pragma once

#include <cstddef>
#include <vector>

#include "numeric/eigen.hpp"

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

/// When to stop before the minimum.
struct GoodEnough {
  double residual = 0.0;  ///< |A z - d| at most
  double gradient = 0.0;  ///< of every variable, over |d|: what freeing it would gain
};

/// Minimises |A z - d| with z_i >= 0 where `bounded`, starting from the empty passive set: for
/// sparse solutions. A may have more columns than rows, dependent ones too. Of several minimisers
/// it finds one.
[[nodiscard]] NonnegativeSolution sparse_nonnegative_least_squares(const Eigen::MatrixXd& a,
                                                                   const Eigen::VectorXd& d,
                                                                   const std::vector<bool>& bounded,
                                                                   std::size_t iteration_limit,
                                                                   const GoodEnough& enough);

}  // namespace tactile_net
