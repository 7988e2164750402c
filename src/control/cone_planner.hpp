/// @file
/// What a plan needs so that its frames obey what contact allows (realtime/cone_plan.hpp). Private.
#pragma once

#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/control/planner.hpp"

namespace tactile_net {

struct ConeTask {
  const LinearProblem& problem;
  double alpha = 0.0;
  const Eigen::MatrixXd& inverse;  ///< tractions from weighted readings
  GridBlocks grid{};               ///< of tractions; of no size: the problem has no mirror images
  double noise_rms = 0.0;          ///< of weighted readings; 0: not known
};

struct PlannedCone {
  ConePlan plan{};
  /// Of drawn frames after 0, 1 ... steps.
  std::vector<ExpectedUnfinished> unfinished{};
};

/// @throw  as `plan_estimator` says of cones
[[nodiscard]] PlannedCone plan_cone(const ConeTask& task, const ConeOptions& options);

}  // namespace tactile_net
