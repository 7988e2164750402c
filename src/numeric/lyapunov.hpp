/// @file
/// Lyapunov's equation. Private.
#pragma once

#include <Eigen/Core>

namespace tactile_net {

/// X of A X + X A' + Q = 0, the covariance of x' = A x + white noise of intensity Q: by the complex
/// Schur form (Bartels and Stewart 1972), about 30 rows^3.
///
/// @param a  square; no two of its eigenvalues sum to 0
/// @param q  symmetric, of a's size
[[nodiscard]] Eigen::MatrixXd solve_lyapunov(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q);

}  // namespace tactile_net
