/// @file
/// The cheapest way to multiply by a matrix within a bound of the error. Private.
#pragma once

#include <optional>
#include <vector>

#include "control/mirror.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/control/planner.hpp"

namespace tactile_net {

struct ProductTask {
  Eigen::MatrixXd matrix{};       ///< A, in coordinates in which 2-norms mean something
  Eigen::VectorXd row_factors{};  ///< the product gives diag(row_factors) A diag(column_factors) x;
  Eigen::VectorXd column_factors{};  ///< constant within a block if symmetric
  Signs row_signs{};                 ///< none: of a skin
  Signs column_signs{};
  Eigen::MatrixXd explained{};  ///< B: the error of A B counts too; empty: it does not
  bool symmetric = false;       ///< J A J = A but for rounding
  double accuracy = 0.0;        ///< of |error|_2 / |A|_2, and of |error B|_2
  std::optional<Structure> structure{};
  std::optional<Precision> precision{};
  bool allow_fft = false;
  bool all_candidates = false;

  // Of skins.
  GridBlocks row_grid{};     ///< with partners where exchanging y and z may leave A as it is; of no
  GridBlocks column_grid{};  ///< size: not to be tried
  /// Where readings are left out: `matrix` is the whole skin's, this is A without them, and `fill`
  /// what they are taken to read, times all readings (theirs count as 0): target = matrix fill.
  Eigen::MatrixXd target{};
  Eigen::MatrixXd fill{};  ///< columns x columns
  std::size_t filled = 0;  ///< readings that are left out, whose fill this product pays for
};

struct PlannedProduct {
  ProductPlan plan{};
  std::vector<Candidate> candidates{};
  double asymmetry = 0.0;  ///< |A - J A J|_F / (2 |A|_2)
  bool symmetric = false;  ///< so that parity and fft can be used
};

/// @throw std::invalid_argument  parity or fft is asked for and A is not symmetric; fft in float32
[[nodiscard]] PlannedProduct plan_product(const ProductTask& task);

}  // namespace tactile_net
