/// @file
/// The cheapest way to multiply by a matrix within a bound of the error. Private.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "control/mirror.hpp"
#include "tactile_net/control/planner.hpp"

namespace tactile_net {

struct ProductTask {
  Eigen::MatrixXd matrix{};       ///< A, in coordinates in which 2-norms mean something
  Eigen::VectorXd row_factors{};  ///< the product gives diag(row_factors) A diag(column_factors) x;
  Eigen::VectorXd column_factors{};  ///< constant within a block if symmetric
  Signs row_signs{};
  Signs column_signs{};
  Eigen::MatrixXd explained{};  ///< B: the error of A B counts too; empty: it does not
  bool symmetric = false;       ///< J A J = A but for rounding
  double accuracy = 0.0;        ///< of |error|_2 / |A|_2, and of |error B|_2
  std::optional<Structure> structure{};
  std::optional<Precision> precision{};
  bool allow_fft = false;
  bool all_candidates = false;
};

struct PlannedProduct {
  ProductPlan plan{};
  std::vector<Candidate> candidates{};
  double asymmetry = 0.0;  ///< |A - J A J|_F / (2 |A|_2)
  bool symmetric = false;  ///< so that parity and fft can be used
};

/// @throw std::invalid_argument  parity or fft is asked for and A is not symmetric; fft in float32
[[nodiscard]] PlannedProduct plan_product(const ProductTask& task);

/// sqrt(|A|_1 |A|_inf) >= |A|_2, also of the matrix of magnitudes.
[[nodiscard]] double norm_bound(const Eigen::MatrixXd& a);

}  // namespace tactile_net
