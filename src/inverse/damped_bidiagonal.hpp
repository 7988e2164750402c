/// @file
/// What damping leaves of a bidiagonal matrix: all that readings K T = U B V' need of singular
/// values, without singular vectors. Private.
///
/// [B; sqrt(alpha)] = Q [R; 0], R upper bidiagonal, by two rotations a column (Elden 1977): no
/// square of B's numbers is ever subtracted from another. A pass takes a few operations a number.
#pragma once

#include "numeric/eigen.hpp"

namespace tactile_net {

/// With several alphas at once.
class DampedBidiagonal {
 public:
  /// @param diagonal  of B, upper bidiagonal and square
  /// @param above     b12, b23 ...: one less
  /// @param alphas    > 0
  DampedBidiagonal(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& above,
                   Eigen::VectorXd alphas);

  /// log det(alpha (B B' + alpha)^-1) of each alpha.
  [[nodiscard]] Eigen::VectorXd log_determinants() const;
  /// tr (B B' + alpha)^-1 B B' of each alpha.
  [[nodiscard]] Eigen::VectorXd traces() const;
  /// alpha g'(B B' + alpha)^-1 g of each column g of U'g: a row an alpha.
  [[nodiscard]] Eigen::MatrixXd left(const Eigen::MatrixXd& rotated) const;
  /// B'(B B' + alpha)^-1 g, a column an alpha.
  [[nodiscard]] Eigen::MatrixXd filtered(const Eigen::VectorXd& rotated) const;
  /// s'(B'B + alpha)^-1 s of each row s of sums of V: a column an alpha.
  [[nodiscard]] Eigen::MatrixXd spreads(const Eigen::MatrixXd& sums) const;
  /// The same of two rows: a'(B'B + alpha)^-1 b of each alpha.
  [[nodiscard]] Eigen::RowVectorXd products(const Eigen::RowVectorXd& a,
                                            const Eigen::RowVectorXd& b) const;

 private:
  [[nodiscard]] Eigen::Index size() const noexcept { return diagonal_.cols(); }

  Eigen::VectorXd alphas_;
  // A row an alpha, a column a column of B.
  Eigen::MatrixXd diagonal_, above_;  // of R
  Eigen::MatrixXd cosine_, sine_;     // of the rotation of a diagonal number with its damping
  Eigen::MatrixXd stay_, pass_;       // of what that leaves: in the residual, and to the next
};

}  // namespace tactile_net
