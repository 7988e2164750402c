/// @file
/// The stabiliser of a problem: as a matrix, for circuits, few of whose entries are not zero; and
/// as what is known of tractions before anything is read.
#pragma once

#include <span>

#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// alpha L'L = alpha m w_u^2 (I + l^2 (Q_y + Q_z)) of each component, m as in linear_problem.hpp,
/// Q: squared differences of neighbouring values over their distance; beyond the grid's ends none,
/// or where tractions fall to 0 there those to 0. (components x values)^2.
///
/// @throw std::invalid_argument  alpha is not > 0 and finite
[[nodiscard]] Matrix stabiliser_matrix(const LinearProblem& problem, double alpha);

/// sqrt(s' (alpha L'L)^-1 s): the deviation of a sum of tractions by the prior alone, over the
/// noise's rms, before anything is read. O(values x (rows + columns)).
///
/// @param weights  s, components x values
/// @throw std::invalid_argument  alpha is not > 0 and finite; the size does not fit
[[nodiscard]] double prior_deviation(const LinearProblem& problem, std::span<const double> weights,
                                     double alpha);

}  // namespace tactile_net
