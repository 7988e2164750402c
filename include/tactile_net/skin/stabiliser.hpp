/// @file
/// The stabiliser of a skin's problem: as a matrix, for circuits, few of whose entries are not
/// zero; and as what is known of tractions before anything is read.
#pragma once

#include <span>

#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// The matrix alpha L'L, (components x cells)^2: for each component
///
///     alpha A/P w_u^2 (I + l^2 (Q_y + Q_z))
///
/// with Q = squared differences of neighbouring cells over their distance, none beyond the grid's
/// ends.
///
/// @throw std::invalid_argument  alpha is not > 0 and finite
[[nodiscard]] Matrix stabiliser_matrix(const SkinProblem& problem, double alpha);

/// sqrt(s' (alpha L'L)^-1 s): the deviation of a sum of tractions by the prior alone, over the
/// noise's rms, before anything is read. O(cells x (rows + columns)).
///
/// @param weights  s, components x cells
/// @throw std::invalid_argument  alpha is not > 0 and finite; the size does not fit
[[nodiscard]] double prior_deviation(const SkinProblem& problem, std::span<const double> weights,
                                     double alpha);

}  // namespace tactile_net
