/// @file
/// The stabiliser of a skin's problem as a matrix, for circuits: few of its entries are not zero.
#pragma once

#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// alpha L'L = alpha A/P w_u^2 (I + l^2 (Q_y + Q_z)) of each component, Q: squared differences of
/// neighbouring cells over their distance, none beyond the grid's ends. (components x cells)^2.
///
/// @throw std::invalid_argument  alpha is not > 0 and finite
[[nodiscard]] Matrix stabiliser_matrix(const SkinProblem& problem, double alpha);

}  // namespace tactile_net
