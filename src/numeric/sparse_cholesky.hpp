/// @file
/// A = R'R of a sparse symmetric matrix, compiled once. Private.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace tactile_net {

/// R is triangular but for an order of its columns that keeps it sparse.
class SparseCholesky {
 public:
  /// @param symmetric  its lower triangle is read
  explicit SparseCholesky(const Eigen::SparseMatrix<double>& symmetric);
  SparseCholesky(SparseCholesky&&) noexcept;
  ~SparseCholesky();

  /// Whether A is positive definite; else nothing may be asked of R.
  [[nodiscard]] bool definite() const noexcept;
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& x) const;             ///< R^-1 x
  [[nodiscard]] Eigen::MatrixXd solve_transposed(const Eigen::MatrixXd& x) const;  ///< R'^-1 x

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

}  // namespace tactile_net
