/// @file
/// Sparse systems, compiled once, as the decompositions of decompositions.hpp. Private.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace tactile_net {

/// P A Q = L U of a square matrix, rows pivoted, columns in an order that keeps it sparse.
class SparseLu {
 public:
  explicit SparseLu(const Eigen::SparseMatrix<double>& a);
  SparseLu(SparseLu&&) noexcept;
  ~SparseLu();

  /// Whether every pivot was found; else nothing may be solved.
  [[nodiscard]] bool regular() const noexcept;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  [[nodiscard]] Eigen::MatrixXd solve_transposed(const Eigen::MatrixXd& b) const;  ///< A'^-1 b
  [[nodiscard]] double reciprocal_condition() const;  ///< estimated, in the 1-norm

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;  // whose transpose() is not const, though it changes nothing
  double norm_ = 0.0;
};

/// P A P' = L D L' of a symmetric matrix.
class SparseLdl {
 public:
  /// @param symmetric  its lower triangle is read
  explicit SparseLdl(const Eigen::SparseMatrix<double>& symmetric);
  SparseLdl(SparseLdl&&) noexcept;
  ~SparseLdl();

  /// Whether no pivot is 0; else nothing may be solved.
  [[nodiscard]] bool regular() const noexcept;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

}  // namespace tactile_net
