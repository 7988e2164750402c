#include "study/planned_frame.hpp"

#include <optional>

#include "study/points.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net::study {

PlannedEstimator plan_of(const StudyInput& input, PlannerOptions options) {
  options.diagnostics = false;
  const auto plan = [&](const auto& scene, const auto&... family) {
    std::optional<LinearProblem> whole;
    if (!scene.scene().dead_taxels.empty()) whole = scene.without({}).problem();
    return plan_estimator(scene.problem(), family..., input.alpha, options,
                          whole ? &*whole : nullptr);
  };
  return input.is_skin() ? plan(input.skin(), input.skin().family()) : plan(input.line());
}

PlannedFrame timed_frame(const EstimatorPlan& plan, std::span<const double> readings,
                         const lab::Clock& clock) {
  ContactEstimator estimator(plan, fft_convolutions());
  PlannedFrame frame{.tractions = std::vector<double>(estimator.tractions()), .seconds = {}};
  ContactEstimate estimate;
  estimate.tractions = frame.tractions;
  frame.seconds = lab::time_of(
      [&] {
        if (estimator.update(readings, estimate) != FrameStatus::ok)
          throw Failed({.kind = Failure::Kind::no_frame});
      },
      0.03, clock);
  return frame;
}

void add_planned_constraints(StudySection& section, const StudyInput& input,
                             const Constraints& constraints, const lab::Clock& clock) {
  const WorkCurve curve{.family = WorkCurve::Family::planned_constraints};
  attempt(section, curve, {}, [&] {
    EstimatorPlan plan =
        plan_of(input,
                {.cone = ConeOptions{.constraints = constraints, .steps = ConePlan::most_steps}})
            .plan;
    const auto after = [&](std::size_t steps) {
      plan.cone->steps = steps;
      const auto [f, seconds] = timed_frame(plan, input.readings, clock);
      WorkPoint result =
          point(input, curve, {.kind = Knob::Kind::steps, .count = steps}, f, seconds);
      result.error_to_solution.reset();  // the constrained problem is another one
      return result;
    };
    for (std::size_t steps = 1; steps < ConePlan::most_steps; steps *= 2)
      section.points.push_back(after(steps));
    return after(ConePlan::most_steps);
  });
}

PlannedFrame planned_frame(const LinearProblem& problem, double alpha,
                           std::span<const double> readings, const lab::Clock& clock) {
  PlannerOptions options;
  options.diagnostics = false;
  return timed_frame(plan_estimator(problem, alpha, options).plan, readings, clock);
}

}  // namespace tactile_net::study
