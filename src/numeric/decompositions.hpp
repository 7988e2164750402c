/// @file
/// The dense decompositions, compiled once: Eigen's templates are slow to compile. Private.
#pragma once

#include <Eigen/Core>

namespace tactile_net {

/// A = U diag(values) V', values descending; U and V thin.
struct Svd {
  Eigen::VectorXd values;
  Eigen::MatrixXd u, v;
};
[[nodiscard]] Svd singular_value_decomposition(const Eigen::MatrixXd& a);

/// The same without vectors.
[[nodiscard]] Eigen::VectorXd singular_values(const Eigen::MatrixXd& a);

/// For the small complex matrices of one frequency: one-sided Jacobi, the most accurate.
struct ComplexSvd {
  Eigen::VectorXd values;
  Eigen::MatrixXcd u, v;
};
[[nodiscard]] ComplexSvd singular_value_decomposition(const Eigen::MatrixXcd& a);

/// R of A = Q R, square.
[[nodiscard]] Eigen::MatrixXd qr_triangle(const Eigen::MatrixXd& a);

/// The x that minimises |A x - b|, for independent columns, by a QR.
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// R^-1 B and B R^-1 for an upper triangular R.
[[nodiscard]] Eigen::MatrixXd solve_upper(const Eigen::MatrixXd& r, const Eigen::MatrixXd& b);
[[nodiscard]] Eigen::MatrixXd divide_upper(const Eigen::MatrixXd& b, const Eigen::MatrixXd& r);

}  // namespace tactile_net
