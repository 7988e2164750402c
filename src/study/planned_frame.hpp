/// @file
/// Private. A frame by the plan that a controller would have.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/inverse/problem.hpp"
#include "tactile_net/lab/stopwatch.hpp"

namespace tactile_net::study {

struct PlannedFrame {
  std::vector<double> tractions;
  lab::Seconds seconds;
};

/// @throw std::invalid_argument, std::domain_error  as `plan_estimator`
[[nodiscard]] PlannedFrame planned_frame(const InverseProblem& problem, double alpha,
                                         std::span<const double> readings, const lab::Clock& clock);

}  // namespace tactile_net::study
