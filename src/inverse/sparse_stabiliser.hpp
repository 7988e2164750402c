/// @file
/// The stabiliser of a problem, its few entries alone. Private.
#pragma once

#include <Eigen/SparseCore>

#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// L'L, as `stabiliser_matrix` has it for alpha = 1.
[[nodiscard]] Eigen::SparseMatrix<double> sparse_stabiliser(const LinearProblem& problem);

}  // namespace tactile_net
