/// @file
/// Readings of dead taxels, filled in with what the live ones predict of them. Private.
///
/// The answer without a reading is that of all readings, where the missing one reads what the
/// others predict (Allen 1974): exactly. So the symmetric factors of a sensor whose taxels all live
/// serve it with dead ones.
#pragma once

#include "numeric/eigen.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/realtime/estimator_plan.hpp"

namespace tactile_net {

/// Weighted readings of all taxels, in terms of themselves: those that live as they are, the others
/// of those that live. Readings x readings; columns of dead readings are 0.
///
/// @param whole           the same problem, all of whose taxels live
/// @param reconstruction  M W^-1 of the problem
/// @param weights         of each reading, as if its taxel lived
[[nodiscard]] Eigen::MatrixXd filled_readings(const LinearProblem& problem,
                                              const LinearProblem& whole,
                                              const Eigen::MatrixXd& reconstruction,
                                              const Eigen::VectorXd& weights);

/// The rows of dead readings, as a plan takes them.
/// @param factors  from what the controller reads to weighted readings
[[nodiscard]] Factor fill_factor(const LinearProblem& problem, const Eigen::MatrixXd& filled,
                                 const Eigen::VectorXd& factors);

}  // namespace tactile_net
