/// @file
/// Tikhonov's method on a skin for one frame, by a QR of the whole problem.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// The minimiser of the functional of skin/problem.hpp, by a QR of the stacked matrix
/// [W K L^-1; sqrt(alpha) I]; with fewer readings than tractions as the shortest z with
/// [W K L^-1, sqrt(alpha) I] z = W g, by a QR of the transposed matrix. Nothing is squared, and no
/// symmetry is used: what `SkinFamily` finds by classes and singular values is checked against it.
/// O((m + n) min(m, n)^2) for K of m x n.
///
/// @return f [Pa], the normal tractions of all cells, then the tangential ones
/// @throw std::invalid_argument  alpha is not > 0 and finite, readings have the wrong size or are
///                               not finite
[[nodiscard]] std::vector<double> tikhonov_solve(const SkinProblem& problem, double alpha,
                                                 std::span<const double> readings);

}  // namespace tactile_net
