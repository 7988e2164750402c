#include "tactile_net/lab/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <variant>

#include "lab/line_answer.hpp"
#include "lab/lines_and_skins.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/resampled.hpp"

namespace tactile_net::lab {
namespace {

constexpr double not_timed = std::numeric_limits<double>::quiet_NaN();

/// Seconds by the clock that was given; NaN without one: not timed.
class Stopwatch {
 public:
  explicit Stopwatch(const std::function<double()>& clock) : clock_(clock) { restart(); }
  [[nodiscard]] bool runs() const { return static_cast<bool>(clock_); }
  void restart() { start_ = now(); }
  [[nodiscard]] double elapsed() const { return now() - start_; }

 private:
  [[nodiscard]] double now() const { return clock_ ? clock_() : not_timed; }
  const std::function<double()>& clock_;
  double start_ = 0.0;
};

/// What all methods of one run share.
struct Run {
  const RunOptions& options;
  const Workload& work;
  SceneProblem problem;
  SceneFrame frame;
  Experiment& experiment;
};

/// Median time of a frame over about 20 ms.
double frame_seconds(const std::function<void()>& solve, const Run& run) {
  const Stopwatch whole(run.options.clock);
  if (!whole.runs()) return not_timed;
  std::vector<double> times;
  while (times.size() < 5 || (whole.elapsed() < 0.02 && times.size() < 1000)) {
    const Stopwatch frame(run.options.clock);
    solve();
    times.push_back(frame.elapsed());
  }
  const auto middle = times.begin() + std::ssize(times) / 2;
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

/// A line's tractions beside the truth, component by component.
void measure(MethodResult& result, const Experiment& experiment, const Surface& surface) {
  const std::size_t n = surface.count;
  std::vector<double> truth = experiment.frame.truth;
  truth.resize(std::max(truth.size(), result.answer.tractions.size()));  // else nothing drags
  result.errors.clear();
  for (std::size_t c = 0; c * n < result.answer.tractions.size(); ++c) {
    const auto found = component(result.answer.tractions, n, c);
    const auto exact = component(truth, n, c);
    result.errors.push_back({.mean_abs = mean_absolute_error(found, exact),
                             .relative = relative_l2_error(found, exact)});
  }
  result.force = sampled_force(component(result.answer.tractions, n, 0), surface.spacing);
}

/// Of a method without bands, with the alpha that it was made for.
FrameAnswer solve_alone(FrameSolver& solver, const Run& run) {
  std::vector<double> f(solver.tractions());
  const FrameResult found = solver.solve(run.frame.readings(), f);
  if (found.status == FrameStatus::too_large) throw FrameOverflow();
  if (found.status != FrameStatus::ok) throw std::domain_error("the readings are not finite");
  FrameAnswer answer{.tractions = std::move(f),
                     .alpha = found.alpha.value_or(ChosenAlpha{}),
                     .verdict = found.verdict,
                     .condition = found.condition,
                     .remarks = found.remarks};
  answer.error_bound = solver.error_bound(run.frame.readings(), answer.tractions);
  return answer;
}

/// Of a method that does not know the scene's constraints.
void note_constraints(MethodResult& result, const Run& run) {
  if (run.problem.constraints())
    note_ignored_constraints(result.answer.verdict, result.answer.remarks);
}

MethodResult reconstruct(Method method, const Run& run) {
  MethodResult result{.method = method};
  try {
    // The sweep chooses for the matrix methods, once for all; dft chooses in its own basis.
    std::optional<ChosenAlpha> alpha;
    const bool chooses_itself =
        traits(method).takes_constraints && run.problem.chooses_on_active_set();
    if (traits(method).needs_alpha && !chooses_itself) alpha = run.frame.alpha();

    const Stopwatch setup(run.options.clock);
    const std::unique_ptr<FrameSolver> solver =
        make_solver(run.problem, method, alpha ? std::optional(alpha->value) : std::nullopt);
    result.setup_seconds = setup.elapsed();
    if (traits(method).has_bands) {
      LineFrameMethod frame({.problem = run.problem,
                             .readings = run.frame.readings(),
                             .analysed = &run.frame,
                             .solver = solver.get(),
                             .alpha = alpha,
                             .takes_mixture = method == Method::tikhonov});
      result.answer = answer(frame);
      if (result.answer.bands && run.work.does(Computation::hidden_modes) &&
          run.problem.hidden().dimension > 0)
        result.answer.remarks.emplace_back(remark::Hidden{run.problem.hidden()});
    } else {
      result.answer = solve_alone(*solver, run);
    }
    measure(result, run.experiment, run.problem.surface());
    std::vector<double> f(solver->tractions());
    const bool is_mean = result.answer.mixture && !run.problem.constraints();
    result.frame_seconds = frame_seconds(
        [&] {
          if (is_mean)
            f = SceneFrame(run.problem, run.frame.readings()).mixture()->mean();
          else
            (void)solver->solve(run.frame.readings(), f);
        },
        run);
    if (!traits(method).takes_constraints) note_constraints(result, run);
  } catch (const std::domain_error& error) {
    result.refusal = error.what();
  } catch (const std::invalid_argument& error) {
    result.refusal = error.what();
  }
  if (!result.refusal.empty()) result.answer.verdict = Verdict::failed;
  return result;
}

/// What the simulator makes of the experiment's circuit.
///
/// @param tractions  those of the nodes as the answer's
/// @throw SimulatorError
void relax(MethodResult& result, Experiment& experiment, Simulator& simulator, Observer& observer,
           const auto& tractions) {
  const Relaxation& relaxation =
      experiment.relaxation.emplace(lab::relax(*experiment.circuit, simulator, observer));
  result.frame_seconds = relaxation.ngspice_seconds;
  FrameAnswer& answer = result.answer;
  answer.tractions = tractions(relaxation.tractions);
  answer.verdict = relaxation.verdict();
  answer.condition = relaxation.condition;
  if (!relaxation.stable) return;
  answer.error_bound = relaxation.explained.total();
  if (!relaxation.resolved())
    answer.remarks.emplace_back(
        remark::VoltagesUnresolved{relaxation.condition.value, relaxation.explained.limit});
}

MethodResult by_network(Simulator& simulator, const Run& run, Observer& observer) {
  MethodResult result{.method = Method::network};
  Experiment& experiment = run.experiment;
  try {
    const Stopwatch setup(run.options.clock);
    const ChosenAlpha alpha = run.frame.alpha();
    experiment.circuit.emplace(run.frame, alpha);
    result.setup_seconds = setup.elapsed();
    result.answer.alpha = alpha;
    const Surface& own = run.problem.surface();
    const Scene& scene = run.problem.scene();
    relax(result, experiment, simulator, observer, [&](const std::vector<double>& found) {
      return scene.network.spacing ? resampled(found, surface(of_circuit(scene)), own) : found;
    });
    measure(result, experiment, own);
    note_constraints(result, run);
  } catch (const SimulatorError& error) {
    result.refusal = error.what();
  } catch (const std::domain_error& error) {
    result.refusal = error.what();
  }
  return result;
}

/// The frame's taxels at the end of their range, and whether an answer can do without them.
remark::Clipped clipped_for_methods(const SceneProblem& problem, std::span<const double> readings) {
  const Scene& scene = problem.scene();
  remark::Clipped clipped = clipped_in(scene, sites(scene.sensor), readings);
  LineProblemOptions rest = problem.options();
  rest.dead_taxels.insert(rest.dead_taxels.end(), clipped.taxels.begin(), clipped.taxels.end());
  clipped.left_out = clipped.range_known && !clipped.taxels.empty() && !problem.is_large() &&
                     is_measured(scene.sensor, rest);
  return clipped;
}

SceneFrame without(const SceneFrame& frame, std::span<const std::size_t> taxels) {
  std::vector<std::size_t> dead = frame.problem().options().dead_taxels;
  dead.insert(dead.end(), taxels.begin(), taxels.end());
  std::sort(dead.begin(), dead.end());
  return {frame.problem().without(dead), frame.readings()};
}

/// Methods without bands take dead taxels for living ones.
void note_clipped_by_method(MethodResult& result, remark::Clipped clipped) {
  if (!result.has_answer()) return;
  clipped.left_out = clipped.left_out && traits(result.method).has_bands;
  note_clipped(result.answer.verdict, result.answer.remarks, std::move(clipped));
}

/// The method whose answer is followed over the scene's time, if there is one.
std::optional<Method> followed(const std::vector<MethodResult>& results) {
  for (const MethodResult& result : results)
    if (result.has_answer() && traits(result.method).has_bands) return result.method;
  return std::nullopt;
}

/// A skin's tractions beside the truth of the same cells: errors over the true pressure.
void measure(MethodResult& result, std::span<const double> truth, const SurfaceGrid& grid) {
  const double pressed = l2_norm(component(truth, grid, Traction::normal));
  for (const Traction which : skin_tractions) {
    const auto found = component(result.answer.tractions, grid, which);
    const auto exact = component(truth, grid, which);
    if (found.empty() || exact.empty()) continue;
    ComponentError& error = result.errors.emplace_back();
    error.mean_abs = mean_absolute_error(found, exact);
    if (!(pressed > 0.0)) continue;
    double off = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) off = std::hypot(off, found[i] - exact[i]);
    error.relative = off / pressed;
  }
  result.force = sampled_force(component(result.answer.tractions, grid, Traction::normal),
                               grid.spacing_y * grid.spacing_z);
}

}  // namespace

std::size_t Experiment::places() const { return of_skin() ? grid.count() : surface(line()).count; }

const MethodResult* Experiment::result(Method method) const noexcept {
  const auto found = std::find_if(results.begin(), results.end(),
                                  [&](const MethodResult& one) { return one.method == method; });
  return found == results.end() ? nullptr : &*found;
}

bool Experiment::succeeded() const noexcept {
  return std::all_of(results.begin(), results.end(), [](const MethodResult& result) {
    return result.answer.verdict != Verdict::failed;
  });
}

std::optional<AlphaRule> Experiment::rule() const noexcept {
  for (const MethodResult& result : results)
    if (result.answer.alpha.rule) return result.answer.alpha.rule;
  return std::nullopt;
}

Experiment run(const Scene& scene, Simulator& simulator, const RunOptions& options,
               Observer& observer) {
  observer.step({Step::Kind::readings});
  const Workload work =
      workload(scene, {.compare_rules = options.compare_rules, .report = options.report});
  Experiment experiment{.scene = scene, .frame = simulate(scene, observer)};
  const SceneProblem problem(scene);
  const Surface& places = problem.surface();
  experiment.sampled_force =
      sampled_force(component(experiment.frame.truth, places.count, 0), places.spacing);
  const SceneFrame frame(problem, experiment.frame.readings);
  const Run run{options, work, frame.problem(), frame, experiment};
  const remark::Clipped clipped = clipped_for_methods(problem, experiment.frame.readings);
  // What a frame has computed stays with it: a copy is made where taxels are left out alone.
  std::optional<Run> of_rest;
  if (clipped.left_out) {
    const SceneFrame rest = without(frame, clipped.taxels);
    of_rest.emplace(Run{options, work, rest.problem(), rest, experiment});
  }
  if (work.does(Computation::rule_comparison)) {
    observer.step({Step::Kind::rules});
    experiment.sweep = run.frame.sweep();
  }
  for (const Method method : scene.reconstruct.methods) {
    observer.step({.kind = Step::Kind::method, .method = method});
    experiment.results.push_back(
        traits(method).has_bands       ? reconstruct(method, of_rest ? *of_rest : run)
        : traits(method).solves_frames ? reconstruct(method, run)
                                       : by_network(simulator, run, observer));
    note_clipped_by_method(experiment.results.back(), clipped);
  }
  if (work.does(Computation::time_course))
    if (const auto method = followed(experiment.results))
      experiment.course = time_course(problem, *method, observer);
  return experiment;
}

Experiment run(const SkinScene& scene, const std::function<double()>& clock, Observer& observer) {
  observer.step({Step::Kind::readings});
  Experiment experiment{.scene = scene, .frame = simulate(scene, observer), .grid = grid(scene)};
  MethodResult& result = experiment.results.emplace_back();
  try {
    observer.step({.kind = Step::Kind::method});
    Stopwatch watch(clock);
    const SkinSceneProblem problem(scene);
    problem.prepare();
    result.setup_seconds = watch.elapsed();
    watch.restart();
    result.answer = solve(problem, experiment.frame.readings);
    result.frame_seconds = watch.elapsed();
    const ChosenAlpha& alpha = result.answer.alpha;
    if (alpha.rule && !problem.is_large())
      experiment.sweep =
          (alpha.tangential_weight ? problem.weighed(*alpha.tangential_weight) : problem)
              .sweep(experiment.frame.readings);
    measure(result, experiment.frame.truth, experiment.grid);
  } catch (const std::domain_error& error) {
    result.refusal = error.what();
  } catch (const std::invalid_argument& error) {
    result.refusal = error.what();
  }
  return experiment;
}

void run_circuit(Experiment& experiment, Simulator& simulator, Observer& observer) {
  MethodResult result{.method = Method::network, .setup_seconds = not_timed};
  try {
    observer.step({.kind = Step::Kind::method, .method = Method::network});
    const SceneCircuit& circuit =
        experiment.circuit.emplace(skin_circuit(experiment.skin(), experiment.frame.readings));
    result.answer.alpha = circuit.alpha();
    relax(result, experiment, simulator, observer,
          [](const std::vector<double>& found) { return found; });
    const auto& own = std::get<SkinScene>(circuit.scene());
    const SurfaceGrid cells = grid(own);
    if (cells.count() != experiment.grid.count()) result.grid = cells;
    measure(result, cell_means(own.contacts, cells), cells);
  } catch (const SimulatorError& error) {
    result.refusal = error.what();
  } catch (const std::domain_error& error) {
    result.refusal = error.what();
  } catch (const std::invalid_argument& error) {
    result.refusal = error.what();
  }
  experiment.results.push_back(std::move(result));
}

}  // namespace tactile_net::lab
