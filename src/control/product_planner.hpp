/// @file
/// The cheapest way to multiply by a matrix within a bound of the error. Private.
#pragma once

#include <optional>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/control/planner.hpp"

namespace tactile_net {

struct ProductTask {
  Eigen::MatrixXd matrix{};       ///< A, in coordinates in which 2-norms mean something
  Eigen::VectorXd row_factors{};  ///< the product gives diag(row_factors) A diag(column_factors) x;
  Eigen::VectorXd column_factors{};  ///< constant within a block if symmetric
  /// With partners where exchanging y and z may leave A as it is. Of no size: A has no reflections.
  GridBlocks row_grid{};
  GridBlocks column_grid{};
  Eigen::MatrixXd explained{};  ///< B: the error of A B counts too; empty: it does not
  bool symmetric = false;       ///< J A J = A may hold: classes are to be tried
  double accuracy = 0.0;        ///< of |error|_2 / |A|_2, and of |error B|_2
  std::optional<Structure> structure{};
  std::optional<Precision> precision{};
  bool allow_fft = false;
  bool all_candidates = false;
  bool full_rank = false;  ///< of low rank no candidate is tried

  /// Where readings are left out: `matrix` is the whole sensor's, this is A without them, and
  /// `fill` what they are taken to read, times all readings (theirs count as 0):
  /// target = matrix fill.
  Eigen::MatrixXd target{};
  Eigen::MatrixXd fill{};  ///< columns x columns
  std::size_t filled = 0;  ///< readings that are left out, whose fill this product pays for
};

/// An accurate candidate before one that is not; of accurate ones the cheaper, else the one that
/// errs less.
[[nodiscard]] bool is_better(const Candidate& one, const Candidate& other);

struct PlannedProduct {
  ProductPlan plan{};
  std::vector<Candidate> candidates{};
  double asymmetry = 0.0;  ///< |A - the classes put together again|_F / |A|_2
  bool symmetric = false;  ///< so that reflections and fft can be used
};

/// @throw std::invalid_argument  reflections or fft are asked for and A is not symmetric; fft in
///                               float32
[[nodiscard]] PlannedProduct plan_product(const ProductTask& task);

}  // namespace tactile_net
