#include "tactile_net/lab/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::lab {
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

/// Splits a method's tractions into components, and each beside the truth.
void measure(MethodResult& result, std::span<const double> f, const Scene& scene,
             const TractionField& truth) {
  const std::size_t n = scene.sensor.count;
  const std::vector<double> no_tangential(n);
  const auto component = [](std::span<const double> traction, std::span<const double> reference) {
    return Component{.traction = {traction.begin(), traction.end()},
                     .mean_abs = mean_absolute_error(traction, reference),
                     .relative_l2 = relative_l2_error(traction, reference)};
  };
  result.normal = component(f.first(n), truth.normal);
  result.force = sampled_force(result.normal.traction, scene.sensor.pitch);
  if (f.size() > n)
    result.tangential =
        component(f.subspan(n), truth.tangential.empty() ? no_tangential : truth.tangential);
}

/// |W (K f - g)| / |W g|; 0 without readings.
double unexplained(const InverseProblem& problem, std::span<const double> readings,
                   std::span<const double> f) {
  double left = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (problem.weights[i] == 0.0) continue;
    const double reading = problem.weights[i] * readings[i];
    const std::span<const double> row = problem.kernel.row(i);
    const double rest = std::inner_product(row.begin(), row.end(), f.begin(), -reading);
    left = std::hypot(left, rest);
    all = std::hypot(all, reading);
  }
  return all > 0.0 ? left / all : 0.0;
}

/// What can be said about the errors of an answer of P f = b.
void judge_errors(MethodResult& result, std::span<const double> f, const Scene& scene,
                  const FrameFacts& facts, const Experiment& experiment) {
  const std::span<const double> readings = experiment.simulation.readings;
  if (!experiment.plan.does(Computation::bands)) {
    result.warnings.emplace_back("no uncertainty is given for an array as large as this");
    return;
  }
  const InverseProblem problem = problem_of(scene);
  const FrameUncertainty uncertainty = uncertainty_of(
      scene, problem, readings, f, facts,
      choose_alone(TikhonovFamily(problem).analyse(readings), AlphaRule::gml, stated_noise(scene)));
  result.noise = uncertainty.noise;
  result.resultant = uncertainty.resultant;
  const auto middle = uncertainty.deviation.begin() + static_cast<std::ptrdiff_t>(problem.count);
  result.normal.deviation.assign(uncertainty.deviation.begin(), middle);
  result.tangential.deviation.assign(middle, uncertainty.deviation.end());
  result.error_bound = forward_bound(problem, *facts.alpha, readings, f, *facts.condition);
  // Under a friction limit f = E z, and E has the condition number max(limit, 1 / limit).
  if (const auto limit = scene.reconstruct.friction_limit; facts.constrained && limit)
    *result.error_bound *= std::max(*limit, 1.0 / *limit);
  if (const double left = unexplained(problem, readings, f); left > 0.5) {
    if (result.verdict == "ok") result.verdict = "oversmoothed";
    result.warnings.push_back("the answer leaves " + brief(100.0 * left) +
                              " % of the readings unexplained: alpha is far too large, or they are "
                              "noise");
  } else if (result.error_bound && *result.error_bound > 1e-3) {
    if (result.verdict == "ok") result.verdict = "ill_conditioned";
    result.warnings.push_back("rounding alone may have moved the answer by " +
                              brief(*result.error_bound) + " of its size; raise alpha");
  }
  const std::string model = model_error_in_words(uncertainty.noise);
  if (!model.empty()) result.warnings.push_back(model);
  if (!experiment.plan.does(Computation::hidden_modes)) return;
  if (const ModeSpace hidden = identifiability(problem).null_space; hidden.dimension > 0)
    result.warnings.push_back("no reading shows: " + hidden.description +
                              "; decided by smoothing, not measured (see identify)");
}

MethodResult reconstruct(const Scene& scene, Method method, const Experiment& experiment) {
  const Simulation& simulation = experiment.simulation;
  MethodResult result{.method = method, .verdict = "failed"};
  try {
    // The sweep has chosen for the matrix methods; dft chooses in its own basis.
    Scene fixed = scene;
    const bool swept = !scene.reconstruct.alpha && method != Method::dft;
    if (swept)
      fixed.reconstruct.alpha = experiment.sweep->choice(scene.reconstruct.alpha_rule).alpha;

    const auto start = Clock::now();
    const std::unique_ptr<Solver> solver = make_solver(fixed, method);
    result.setup_seconds = since(start);
    std::vector<double> f(solver->tractions());
    if (solver->solve(simulation.readings, f) != FrameStatus::ok)
      throw std::domain_error("the readings are not finite");
    result.frame_seconds = frame_seconds(*solver, simulation.readings, f);

    const FrameFacts& facts = solver->facts();
    result.alpha = facts.alpha;
    if (result.alpha)
      result.alpha_rule = scene.reconstruct.alpha ? "given" : name(scene.reconstruct.alpha_rule);
    result.verdict = facts.verdict;
    result.condition = facts.condition;
    result.error_bound = solver->error_bound(simulation.readings, f);
    result.warnings = facts.warnings;
    result.constrained = facts.constrained;
    if (swept) {
      const AlphaVerdict verdict = experiment.sweep->choice(scene.reconstruct.alpha_rule).verdict;
      if (verdict != AlphaVerdict::ok) result.verdict = name(verdict);
    }
    measure(result, f, scene, simulation.truth);
    if (method != Method::dft) judge_errors(result, f, scene, facts, experiment);
    if (method == Method::closed_form && constraints_of(scene))
      result.warnings.emplace_back("the constraints bind the method tikhonov alone");
  } catch (const std::domain_error& error) {
    result.failure = error.what();
  } catch (const std::invalid_argument& error) {
    result.failure = error.what();
  }
  return result;
}

MethodResult by_network(const Scene& scene, Simulator& simulator, Experiment& experiment,
                        Observer& observer) {
  MethodResult result{.method = Method::network, .verdict = "failed"};
  try {
    const auto start = Clock::now();
    const double alpha = scene.reconstruct.alpha
                             ? *scene.reconstruct.alpha
                             : experiment.sweep->choice(scene.reconstruct.alpha_rule).alpha;
    const CircuitPlan plan = plan_circuit(scene, experiment.simulation.readings, alpha);
    experiment.deck = deck_text(plan, Answer::printed);
    result.setup_seconds = since(start);
    result.alpha = alpha;
    result.alpha_rule = scene.reconstruct.alpha ? "given" : name(scene.reconstruct.alpha_rule);
    const Relaxation relaxation = relax(plan, simulator, observer);
    result.frame_seconds = relaxation.ngspice_seconds;
    result.condition = relaxation.condition;
    measure(result, relaxation.tractions, scene, experiment.simulation.truth);
    experiment.relaxation = relaxation;
    result.failure = relaxation.failure();
    if (result.failure.empty())
      result.verdict = !relaxation.resolved()         ? "ill_conditioned"
                       : relaxation.difference > 0.01 ? "inaccurate"
                                                      : "ok";
    for (const std::string& warning : relaxation.warnings) result.warnings.push_back(warning);
    if (relaxation.stable && !relaxation.resolved())
      result.warnings.push_back("P has condition number " + brief(relaxation.condition) +
                                ": rounding alone may change the voltages by " +
                                brief(relaxation.limit) + "; raise alpha");
    if (relaxation.stable)
      result.error_bound =
          relaxation.limit + relaxation.curves + 1.2 * relaxation.predicted.value_or(0.0);
    if (constraints_of(scene))
      result.warnings.emplace_back("the constraints bind the method tikhonov alone");
  } catch (const SimulatorError& error) {
    result.failure = error.what();
  } catch (const std::domain_error& error) {
    result.failure = error.what();
  }
  return result;
}

}  // namespace

bool Experiment::succeeded() const noexcept {
  return std::all_of(results.begin(), results.end(),
                     [](const MethodResult& result) { return result.failure.empty(); });
}

Experiment run_experiment(const Scene& scene, const ScenePlan& plan, Simulator& simulator,
                          Observer& observer) {
  observer.step({Step::Kind::readings});
  Experiment experiment{.scene = scene,
                        .plan = plan,
                        .simulation = simulate(scene),
                        .force = total_force(scene),
                        .sampled_force = 0.0,
                        .sweep = {},
                        .results = {},
                        .relaxation = {},
                        .course = {},
                        .deck = {}};
  experiment.sampled_force = sampled_force(experiment.simulation.truth.normal, scene.sensor.pitch);
  if (plan.does(Computation::rule_comparison)) {
    observer.step({Step::Kind::rules});
    experiment.sweep = sweep_of(scene, experiment.simulation.readings);
  }
  for (const Method method : scene.reconstruct.methods) {
    observer.step({.kind = Step::Kind::method, .method = method});
    experiment.results.push_back(method == Method::network
                                     ? by_network(scene, simulator, experiment, observer)
                                     : reconstruct(scene, method, experiment));
  }
  if (plan.does(Computation::time_course)) {
    const auto solved = std::find_if(
        experiment.results.begin(), experiment.results.end(), [](const MethodResult& result) {
          return result.has_answer() &&
                 (result.method == Method::tikhonov || result.method == Method::closed_form);
        });
    if (solved != experiment.results.end())
      experiment.course = time_course(scene, solved->method, observer);
  }
  return experiment;
}

}  // namespace tactile_net::lab
