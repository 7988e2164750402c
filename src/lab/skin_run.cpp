#include "tactile_net/lab/skin_run.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tactile_net/numeric/comparison.hpp"

namespace tactile_net::lab {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double size_of(std::span<const double> values) {
  double size = 0.0;
  for (const double value : values) size = std::hypot(size, value);
  return size;
}

std::array<double, 3> errors(const SkinExperiment& experiment) {
  std::array<double, 3> relative{unknown, unknown, unknown};
  const double pressed =
      size_of(component(experiment.frame.truth, experiment.grid, SkinTraction::normal));
  for (std::size_t c = 0; c < relative.size(); ++c) {
    const auto found = component(experiment.answer->tractions, experiment.grid, skin_tractions[c]);
    const auto truth = component(experiment.frame.truth, experiment.grid, skin_tractions[c]);
    if (found.empty() || !(pressed > 0.0)) continue;
    double off = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) off = std::hypot(off, found[i] - truth[i]);
    relative[c] = off / pressed;
  }
  return relative;
}

}  // namespace

SkinExperiment run(const SkinScene& scene, const std::function<double()>& clock,
                   Observer& observer) {
  observer.step({Step::Kind::readings});
  SkinExperiment experiment{
      .scene = scene, .grid = grid(scene), .frame = simulate(scene, observer)};
  experiment.relative = {unknown, unknown, unknown};
  const auto now = [&] { return clock ? clock() : unknown; };
  try {
    observer.step({.kind = Step::Kind::method});
    const double start = now();
    const SkinSceneProblem problem(scene);
    problem.prepare();
    const double ready = now();
    experiment.answer = solve(problem, experiment.frame.readings);
    experiment.setup_seconds = ready - start;
    experiment.frame_seconds = now() - ready;
    experiment.relative = errors(experiment);
  } catch (const std::domain_error& error) {
    experiment.refusal = error.what();
  } catch (const std::invalid_argument& error) {
    experiment.refusal = error.what();
  }
  return experiment;
}

}  // namespace tactile_net::lab
