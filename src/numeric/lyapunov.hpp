/// @file
/// Lyapunov's equation. Private.
#pragma once

#include <Eigen/Core>

namespace tactile_net {

/// X of A X + X A' + Q = 0, the covariance of x' = A x + white noise of intensity Q: by the complex
/// Schur form (Bartels and Stewart 1972), about 25 rows^3 once and 5 rows^3 a Q.
class Lyapunov {
 public:
  /// @param a  square; no two of its eigenvalues sum to 0
  explicit Lyapunov(const Eigen::MatrixXd& a);

  /// Of A's eigenvalues.
  [[nodiscard]] double largest_real_part() const;

  /// @param q  symmetric, of a's size
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& q) const;

 private:
  Eigen::MatrixXcd u_, t_;
};

}  // namespace tactile_net
