/// @file
/// Private. A frame by the plan that a controller would have.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/study/input.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::study {

/// Of the study's problem, a line's or a skin's.
/// @throw std::invalid_argument, std::domain_error  as `plan_estimator`
[[nodiscard]] PlannedEstimator plan_of(const StudyInput& input, PlannerOptions options);

struct PlannedFrame {
  std::vector<double> tractions;
  lab::Seconds seconds;
};

/// Without diagnostics.
/// @throw Failed  the estimator refuses the frame
[[nodiscard]] PlannedFrame timed_frame(const EstimatorPlan& plan, std::span<const double> readings,
                                       const lab::Clock& clock);

/// Adds a point for each of 1, 2, 4 ... steps of a plan towards the constraints.
void add_planned_constraints(StudySection& section, const StudyInput& input,
                             const Constraints& constraints, const lab::Clock& clock);

/// @throw std::invalid_argument, std::domain_error  as `plan_estimator`
[[nodiscard]] PlannedFrame planned_frame(const LinearProblem& problem, double alpha,
                                         std::span<const double> readings, const lab::Clock& clock);

}  // namespace tactile_net::study
