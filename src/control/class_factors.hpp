/// @file
/// Factors of a matrix's classes, and how far they may be from it. Private.
#pragma once

#include <optional>
#include <vector>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/realtime/product_plan.hpp"

namespace tactile_net {

/// One class of the matrix in its orthonormal basis; without symmetry the matrix itself.
struct MatrixClass {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd row_scale;  // to plain sums and differences, and the task's factors
  Eigen::VectorXd column_scale;
  Eigen::MatrixXd explained;  // the task's, in this basis; of several images side by side
  Eigen::MatrixXd reach{};    // all x there may be, likewise; empty: any
  std::size_t images = 1;     // classes of the whole that have this matrix
  std::optional<Svd> svd{};
};

/// Bounds of what is computed minus A: norm of the difference, of the difference times `explained`,
/// and of the rounding of the sums.
struct ProductError {
  double matrix = 0.0;
  double explained = 0.0;
  double rounding = 0.0;
};

/// Bound of a sum of `terms` terms, over the sum of their magnitudes (Higham 2002, 3.1), and of
/// three more roundings: the entry's, the reading's, the result's.
[[nodiscard]] double rounding(Precision precision, std::size_t terms);

[[nodiscard]] Factor factor_of(const Eigen::MatrixXd& a);

[[nodiscard]] double largest(const std::vector<Eigen::MatrixXd>& matrices);

/// The power of two that brings the largest entry into [1/2, 1).
[[nodiscard]] double power_of_two(double size);

/// |A|_2 from below, by power iteration.
[[nodiscard]] double norm_from_below(const Eigen::MatrixXd& a);

/// sqrt(|A|_1 |A|_inf) >= |A|_2, also of the matrix of magnitudes.
[[nodiscard]] double norm_bound(const Eigen::MatrixXd& a);

/// From the orthonormal basis to plain sums and differences, and the task's own units.
void fold(const std::vector<MatrixClass>& parts, std::vector<Eigen::MatrixXd>& first,
          std::vector<Eigen::MatrixXd>& second);

/// The difference of the stored factors, measured, and the rounding of the sums, bounded; back in
/// the orthonormal basis.
///
/// @param explained_norm  of what the error is multiplied by, from above
/// @param negligible      where that shows an error below it, no product is taken for a smaller one
[[nodiscard]] ProductError error_of(const MatrixClass& part, Eigen::MatrixXd first,
                                    const Eigen::MatrixXd* second, Precision precision,
                                    double explained_norm, double negligible);

}  // namespace tactile_net
