/// @file
/// A = L L', compiled once, as the decompositions of decompositions.hpp. Private.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace tactile_net {

/// Of a symmetric matrix, whose lower triangle is read.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& symmetric);
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;
  ~Cholesky();

  [[nodiscard]] bool is_positive_definite() const noexcept;
  [[nodiscard]] double reciprocal_condition() const;  ///< estimated, in the 1-norm
  /// log det A. @pre  A is positive definite
  [[nodiscard]] double log_determinant() const;
  /// x = A^-1 x, column by column. @pre  A is positive definite
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> x) const;
  /// L^-1 x.
  [[nodiscard]] Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& x) const;

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

}  // namespace tactile_net
