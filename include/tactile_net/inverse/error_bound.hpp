/// @file
/// What rounding can have done to a reconstruction: a bound of its forward error.
#pragma once

#include <cstddef>
#include <span>

#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// The first-order bound of least squares, relative to |x|_2 (Wedin 1973; Bjorck, Numerical Methods
/// for Least Squares Problems, 1996, 1.4.27), for min |A x - b|_2 with residual r and perturbations
/// of A and b that are `perturbation` times their size:
///
///     perturbation (kappa (1 + |b| / (|A| |x|) + kappa |r| / (|A| |x|)) + 1)
///
/// @param condition      kappa = |A| |A^+|, >= 1
/// @param matrix_norm    |A|_2
/// @param right_norm     |b|_2
/// @param residual_norm  |r|_2
/// @param solution_norm  |x|_2; the bound is infinite for 0, unless b is 0 too
[[nodiscard]] double wedin_bound(double condition, double matrix_norm, double right_norm,
                                 double residual_norm, double solution_norm,
                                 double perturbation) noexcept;

/// Refuses a stacked matrix whose columns double precision cannot tell apart.
///
/// @param condition  2-norm condition number of the matrix
/// @param rows       number of its rows
/// @throw std::domain_error  condition is not below 1 / (epsilon rows)
void require_full_rank(double condition, std::size_t rows);

/// `wedin_bound` for the stacked problem [W K; sqrt(alpha) L] f = [W g; 0], with the error of the
/// kernel's entries and of a QR of that size (sqrt(rows) units of rounding) as the perturbation. It
/// says how far `tractions` may be, relative to their 2-norm, from the exact minimiser of the
/// functional of linear_problem.hpp; what alpha smooths away and what noise adds are not in it.
/// O(rows x columns).
///
/// @param condition  2-norm condition number of the stacked matrix: `Reconstruction::condition`
[[nodiscard]] double forward_bound(const LinearProblem& problem, double alpha,
                                   std::span<const double> readings,
                                   std::span<const double> tractions, double condition);

}  // namespace tactile_net
