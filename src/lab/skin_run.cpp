#include "tactile_net/lab/skin_run.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <variant>

#include "tactile_net/numeric/comparison.hpp"

namespace tactile_net::lab {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double size_of(std::span<const double> values) {
  double size = 0.0;
  for (const double value : values) size = std::hypot(size, value);
  return size;
}

std::array<double, 3> errors(const std::vector<double>& tractions,
                             const std::vector<double>& of_contacts, const SurfaceGrid& grid) {
  std::array<double, 3> relative{unknown, unknown, unknown};
  const double pressed = size_of(component(of_contacts, grid, Traction::normal));
  for (std::size_t c = 0; c < relative.size(); ++c) {
    const auto found = component(tractions, grid, skin_tractions[c]);
    const auto truth = component(of_contacts, grid, skin_tractions[c]);
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
    experiment.relative =
        errors(experiment.answer->tractions, experiment.frame.truth, experiment.grid);
  } catch (const std::domain_error& error) {
    experiment.refusal = error.what();
  } catch (const std::invalid_argument& error) {
    experiment.refusal = error.what();
  }
  return experiment;
}

void run_circuit(SkinExperiment& experiment, Simulator& simulator, Observer& observer) {
  SkinCircuitResult& result = experiment.network.emplace();
  result.relative = {unknown, unknown, unknown};
  try {
    observer.step({.kind = Step::Kind::method, .method = Method::network});
    result.circuit.emplace(skin_circuit(experiment.scene, experiment.frame.readings));
    result.relaxation = relax(*result.circuit, simulator, observer);
    // The nodes may stand for larger cells than the answer's.
    const auto& own = std::get<SkinScene>(result.circuit->scene());
    const std::vector<double> truth = cell_means(own.contacts, grid(own));
    result.relative = errors(result.relaxation->tractions, truth, grid(own));
  } catch (const SimulatorError& error) {
    result.refusal = error.what();
  } catch (const std::domain_error& error) {
    result.refusal = error.what();
  } catch (const std::invalid_argument& error) {
    result.refusal = error.what();
  }
}

}  // namespace tactile_net::lab
