#include "study/planned_frame.hpp"

#include "tactile_net/control/planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net::study {

PlannedFrame planned_frame(const InverseProblem& problem, double alpha,
                           std::span<const double> readings, const lab::Clock& clock) {
  PlannerOptions options;
  options.diagnostics = false;
  ContactEstimator estimator(plan_estimator(problem, alpha, options).plan);
  PlannedFrame frame{.tractions = std::vector<double>(estimator.tractions()), .seconds = {}};
  ContactEstimate estimate;
  estimate.tractions = frame.tractions;
  frame.seconds = lab::time_of([&] { (void)estimator.update(readings, estimate); }, 0.03, clock);
  return frame;
}

}  // namespace tactile_net::study
