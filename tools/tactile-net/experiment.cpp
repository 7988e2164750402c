#include "experiment.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tactile_net/inverse/comparison.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/sensing/spectral.hpp"
#include "text.hpp"

namespace tactile_net::tool {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Median time of a frame over about 20 ms.
double frame_seconds(Solver& solver, std::span<const double> readings, std::span<double> f) {
  std::vector<double> times;
  const auto start = Clock::now();
  while (times.size() < 5 || (since(start) < 0.02 && times.size() < 1000)) {
    const auto frame = Clock::now();
    (void)solver.solve(readings, f);
    times.push_back(since(frame));
  }
  const auto middle = times.begin() + std::ssize(times) / 2;
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

void measure(MethodResult& result, const Scene& scene, const Simulation& simulation) {
  result.mean_abs = mean_absolute_error(result.normal, simulation.truth.normal);
  result.relative_l2 = relative_l2_error(result.normal, simulation.truth.normal);
  result.force = sampled_force(result.normal, scene.sensor.pitch);
}

/// dft's verdict depends on the frame: it takes the array for a ring.
void judge_frame(const DftInverse& dft, std::span<const double> readings, MethodResult& result) {
  const DftVerdict verdict = dft.verdict(readings);
  result.verdict = name(verdict);
  if (verdict == DftVerdict::cut_off)
    result.warnings.emplace_back(
        "the readings have not died away at the array's ends: dft takes the array for a ring, and "
        "what is cut off comes back amplified");
}

MethodResult reconstruct(const Scene& scene, Method method, const Simulation& simulation) {
  MethodResult result{.method = method, .verdict = "failed"};
  try {
    const auto start = Clock::now();
    Solver solver = make_solver(scene, method);
    result.setup_seconds = since(start);
    result.alpha = solver.alpha;
    result.condition = solver.condition;
    result.warnings = solver.warnings;

    std::vector<double> f(scene.sensor.count);
    if (solver.solve(simulation.readings, f) != Status::ok)
      throw std::domain_error("the readings are not finite");
    result.frame_seconds = frame_seconds(solver, simulation.readings, f);
    result.verdict = solver.verdict;
    if (const auto* dft = std::get_if<DftInverse>(&solver.inverse))
      judge_frame(*dft, simulation.readings, result);
    result.normal = std::move(f);
    measure(result, scene, simulation);
  } catch (const std::domain_error& error) {
    result.failure = error.what();
  } catch (const std::invalid_argument& error) {
    result.failure = error.what();
  }
  return result;
}

MethodResult by_network(const Scene& scene, const NgspiceOptions& ngspice, Experiment& experiment) {
  MethodResult result{.method = Method::network, .verdict = "failed"};
  try {
    const auto start = Clock::now();
    const CircuitPlan plan = plan_circuit(scene, experiment.simulation.readings);
    experiment.deck = deck_text(plan, Answer::printed);
    result.setup_seconds = since(start);
    result.alpha = scene.reconstruct.alpha;
    const Relaxation relaxation = relax(plan, ngspice);
    result.frame_seconds = relaxation.ngspice_seconds;
    result.condition = relaxation.condition;
    result.normal = relaxation.tractions;
    measure(result, scene, experiment.simulation);
    experiment.relaxation = relaxation;
    if (!relaxation.stable)
      result.failure = "P is not positive definite: the circuit would not settle";
    else if (!relaxation.agrees())
      result.failure = "the circuit differs from the direct solve by " +
                       brief(relaxation.difference) + ", more than rounding explains (" +
                       brief(relaxation.limit) + ")";
    else
      result.verdict = relaxation.resolved() ? "ok" : "ill_conditioned";
    if (relaxation.stable && !relaxation.resolved())
      result.warnings.push_back("P has condition number " + brief(relaxation.condition) +
                                ": rounding alone may change the voltages by " +
                                brief(relaxation.limit) + "; raise alpha");
  } catch (const SimulatorError& error) {
    result.failure = error.what();
  } catch (const std::domain_error& error) {
    result.failure = error.what();
  }
  return result;
}

/// How much of the contacts' force lies beyond the array's ends, where no taxel sits above it.
double force_outside(const Scene& scene) {
  const double end = position(scene.sensor, scene.sensor.count - 1) + scene.sensor.pitch / 2;
  double outside = 0.0;
  for (const Contact& contact : scene.contacts)
    outside +=
        resultant(contact, Traction::normal) - force_between(contact, Traction::normal, -end, end);
  return outside;
}

std::vector<std::string> warnings_of(const Scene& scene, double force) {
  std::vector<std::string> warnings;
  const auto rigid = [](const Contact& contact) {
    return std::holds_alternative<RigidContact>(contact);
  };
  if (std::any_of(scene.contacts.begin(), scene.contacts.end(), has_friction))
    warnings.emplace_back(
        "the scene has friction, and this version solves for the normal traction alone: what the "
        "tangential traction adds to the readings is taken for normal traction");
  if (std::all_of(scene.contacts.begin(), scene.contacts.end(), rigid)) {
    const double outside = force_outside(scene);
    if (outside > 1e-12 * force)
      warnings.push_back(brief(100.0 * outside / force) +
                         " % of the normal force lies beyond the ends of the array");
  }
  return warnings;
}

double total_force(const Scene& scene) {
  double force = 0.0;
  for (const Contact& contact : scene.contacts) force += resultant(contact, Traction::normal);
  return force;
}

}  // namespace

Simulation simulate(const Scene& scene) {
  Simulation simulation{.truth = sample(scene.contacts, scene.sensor),
                        .readings = {},
                        .warnings = warnings_of(scene, total_force(scene))};
  simulation.readings = scene.forward == ForwardModel::exact
                            ? exact_readings(scene.sensor, scene.material, scene.contacts)
                            : fast_sampled_readings(scene.sensor, scene.material, simulation.truth);

  const std::vector<Channel> all = channels(scene.sensor);
  for (std::size_t c = 0; c < all.size(); ++c) {
    const auto readings =
        std::span(simulation.readings).subspan(c * scene.sensor.count, scene.sensor.count);
    if (scene.noise)
      add_noise(readings, scene.noise->rms.at(all[c].quantity), scene.noise->seed, c);
    if (scene.quantization) quantize(readings, *scene.quantization);
    if (!scene.dead_taxels.empty()) kill(readings, scene.dead_taxels);
  }
  return simulation;
}

bool Experiment::succeeded() const noexcept {
  return std::all_of(results.begin(), results.end(),
                     [](const MethodResult& result) { return result.failure.empty(); });
}

Experiment run_experiment(const Scene& scene, const NgspiceOptions& ngspice, Progress& progress) {
  progress.step("simulating the readings ...");
  Experiment experiment{.scene = scene,
                        .simulation = simulate(scene),
                        .force = total_force(scene),
                        .sampled_force = 0.0,
                        .results = {},
                        .relaxation = {},
                        .deck = {}};
  experiment.sampled_force = sampled_force(experiment.simulation.truth.normal, scene.sensor.pitch);
  for (const Method method : scene.reconstruct.methods) {
    progress.step(std::string(name(method)) + " ...");
    experiment.results.push_back(method == Method::network
                                     ? by_network(scene, ngspice, experiment)
                                     : reconstruct(scene, method, experiment.simulation));
  }
  return experiment;
}

}  // namespace tactile_net::tool
