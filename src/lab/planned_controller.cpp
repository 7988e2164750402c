#include "tactile_net/lab/planned_controller.hpp"

#include <algorithm>
#include <vector>

#include "tactile_net/lab/simulated_frame.hpp"

namespace tactile_net::lab {
namespace {

/// The middle of what the rule chooses on each frame.
std::optional<PlanAlpha> median_alpha(const SceneProblem& problem, const NextFrame& next,
                                      Observer& observer) {
  std::vector<double> readings(problem.readings());
  std::vector<double> alphas;
  while (next(readings)) {
    observer.step({.kind = Step::Kind::frame, .count = alphas.size()});
    alphas.push_back(SceneFrame(problem, readings).alpha().value);
  }
  if (alphas.empty()) return std::nullopt;
  const auto middle = alphas.begin() + std::ssize(alphas) / 2;
  std::nth_element(alphas.begin(), middle, alphas.end());
  return PlanAlpha{.value = *middle,
                   .source = PlanAlpha::Source::recording,
                   .rule = problem.scene().reconstruct.alpha_rule,
                   .frames = alphas.size()};
}

}  // namespace

std::optional<PlanAlpha> plan_alpha(const SceneProblem& problem, const NextFrame& next,
                                    Observer& observer) {
  const Scene& scene = problem.scene();
  if (scene.reconstruct.alpha) return PlanAlpha{.value = *scene.reconstruct.alpha};
  if (next) return median_alpha(problem, next, observer);
  if (scene.contacts.empty()) return std::nullopt;
  return PlanAlpha{.value = SceneFrame(problem, simulate(scene).readings).alpha().value,
                   .source = PlanAlpha::Source::contact,
                   .rule = scene.reconstruct.alpha_rule};
}

PlannedController plan_controller(const SceneProblem& problem, const PlanAlpha& alpha,
                                  PlannerOptions options) {
  const Scene& scene = problem.scene();
  options.noise_rms = problem.stated_noise().value_or(0.0);
  if (!options.friction_coefficient)
    options.friction_coefficient = scene.reconstruct.friction_limit;
  if (scene.quantization)
    options.ranges.assign(channels(scene.sensor).size(),
                          {scene.quantization->low, scene.quantization->high});
  options.label = scene.title.empty() ? scene.file : scene.title;
  return {.alpha = alpha, .estimator = plan_estimator(problem.problem(), alpha.value, options)};
}

}  // namespace tactile_net::lab
