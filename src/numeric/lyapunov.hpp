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

  /// The covariance of x' = A x + noise of intensity Q / f from `lowest` on [radians per time], f
  /// in cycles: exact, by F = integral of Re (j w - A)^-1 / w from there on, = (-A)^-1 Re log(1 - j
  /// A / lowest), since A X + X A' + 2 (F Q + Q F') = 0.
  ///
  /// @param q       symmetric, of a's size: two-sided, at 1 cycle per time
  /// @param lowest  > 0
  /// @pre           A's eigenvalues have negative real parts
  [[nodiscard]] Eigen::MatrixXd solve_flicker(const Eigen::MatrixXd& q, double lowest) const;

 private:
  Eigen::MatrixXcd u_, t_;
};

}  // namespace tactile_net
