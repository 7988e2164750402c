#include "tactile_net/lab/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

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
  SceneProblem problem;
  SceneFrame frame;
  Experiment& experiment;
};

/// Median time of a frame over about 20 ms.
double frame_seconds(FrameSolver& solver, const Run& run) {
  const Stopwatch whole(run.options.clock);
  if (!whole.runs()) return not_timed;
  std::vector<double> f(solver.tractions());
  std::vector<double> times;
  while (times.size() < 5 || (whole.elapsed() < 0.02 && times.size() < 1000)) {
    const Stopwatch frame(run.options.clock);
    (void)solver.solve(run.frame.readings(), f);
    times.push_back(frame.elapsed());
  }
  const auto middle = times.begin() + std::ssize(times) / 2;
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

/// Splits a method's tractions into components, and each beside the truth.
void measure(MethodResult& result, std::span<const double> f, const Surface& surface,
             const TractionField& truth) {
  const std::size_t n = surface.count;
  const std::vector<double> no_tangential(n);
  const auto component = [](std::span<const double> traction, std::span<const double> reference) {
    return Component{.traction = {traction.begin(), traction.end()},
                     .mean_abs = mean_absolute_error(traction, reference),
                     .relative_l2 = relative_l2_error(traction, reference)};
  };
  result.normal = component(f.first(n), truth.normal);
  result.force = sampled_force(result.normal.traction, surface.spacing);
  if (f.size() > n)
    result.tangential =
        component(f.subspan(n), truth.tangential.empty() ? no_tangential : truth.tangential);
}

/// What an answer with bands says beside its tractions.
void take_answer(MethodResult& result, FrameAnswer&& found, const Run& run) {
  result.verdict = found.verdict;
  result.condition = found.condition;
  result.error_bound = found.error_bound;
  result.constrained = std::move(found.constrained);
  result.data = std::move(found.data);
  result.offsets = std::move(found.offsets);
  result.remarks = std::move(found.remarks);
  if (!found.bands) return;
  result.noise = found.noise;
  result.resultant = found.bands->resultant;
  result.patches = found.bands->patches;
  const auto middle =
      found.deviations.begin() + static_cast<std::ptrdiff_t>(run.problem.surface().count);
  result.normal.deviation.assign(found.deviations.begin(), middle);
  result.tangential.deviation.assign(middle, found.deviations.end());
  if (run.experiment.work.does(Computation::hidden_modes) && run.problem.hidden().dimension > 0)
    result.remarks.emplace_back(remark::Hidden{run.problem.hidden()});
}

/// Of a method without bands, with the alpha that it was made for.
std::vector<double> solve_alone(MethodResult& result, FrameSolver& solver, const Run& run) {
  std::vector<double> f(solver.tractions());
  const FrameResult answer = solver.solve(run.frame.readings(), f);
  if (answer.status == FrameStatus::too_large) throw FrameOverflow();
  if (answer.status != FrameStatus::ok) throw std::domain_error("the readings are not finite");
  result.alpha = answer.alpha;
  result.verdict = answer.verdict;
  result.condition = answer.condition;
  result.error_bound = solver.error_bound(run.frame.readings(), f);
  result.remarks = answer.remarks;
  return f;
}

/// Of a method that does not know the scene's constraints: it has answered another question, which
/// weighs more than how well.
void note_constraints(MethodResult& result, const Run& run) {
  if (!run.problem.constraints()) return;
  result.remarks.emplace_back(remark::ConstraintsIgnored{});
  if (result.verdict != Verdict::failed) result.verdict = Verdict::unconstrained;
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
                             .alpha = alpha});
      FrameAnswer found = answer(frame);
      measure(result, found.tractions, run.problem.surface(), run.experiment.frame.truth);
      result.alpha = found.alpha;
      take_answer(result, std::move(found), run);
    } else {
      measure(result, solve_alone(result, *solver, run), run.problem.surface(),
              run.experiment.frame.truth);
    }
    result.frame_seconds = frame_seconds(*solver, run);
    if (!traits(method).takes_constraints) note_constraints(result, run);
  } catch (const std::domain_error& error) {
    result.refusal = error.what();
  } catch (const std::invalid_argument& error) {
    result.refusal = error.what();
  }
  if (!result.refusal.empty()) result.verdict = Verdict::failed;
  return result;
}

MethodResult by_network(Simulator& simulator, const Run& run, Observer& observer) {
  MethodResult result{.method = Method::network};
  Experiment& experiment = run.experiment;
  try {
    const Stopwatch setup(run.options.clock);
    const ChosenAlpha alpha = run.frame.alpha();
    const SceneCircuit& circuit = experiment.circuit.emplace(run.frame, alpha);
    result.setup_seconds = setup.elapsed();
    result.alpha = alpha;
    const Relaxation relaxation = relax(circuit, simulator, observer);
    result.frame_seconds = relaxation.ngspice_seconds;
    result.condition = relaxation.condition;
    const Surface& own = run.problem.surface();
    const Scene& scene = run.problem.scene();
    measure(result,
            scene.network.spacing ? resampled(relaxation.tractions, surface(of_circuit(scene)), own)
                                  : relaxation.tractions,
            own, experiment.frame.truth);
    experiment.relaxation = relaxation;
    result.verdict = relaxation.verdict();
    if (relaxation.stable && !relaxation.resolved())
      result.remarks.emplace_back(
          remark::VoltagesUnresolved{relaxation.condition.value, relaxation.explained.limit});
    if (relaxation.stable) result.error_bound = relaxation.explained.total();
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
  note_clipped(result.verdict, result.remarks, std::move(clipped));
}

/// The method whose answer is followed over the scene's time, if there is one.
std::optional<Method> followed(const std::vector<MethodResult>& results) {
  for (const MethodResult& result : results)
    if (result.has_answer() && traits(result.method).has_bands) return result.method;
  return std::nullopt;
}

}  // namespace

bool Experiment::succeeded() const noexcept {
  return std::all_of(results.begin(), results.end(),
                     [](const MethodResult& result) { return result.verdict != Verdict::failed; });
}

std::optional<AlphaRule> Experiment::rule() const noexcept {
  for (const MethodResult& result : results)
    if (result.alpha && result.alpha->rule) return result.alpha->rule;
  return std::nullopt;
}

Experiment run(const Scene& scene, Simulator& simulator, const RunOptions& options,
               Observer& observer) {
  observer.step({Step::Kind::readings});
  Experiment experiment{
      .scene = scene,
      .work = workload(scene, {.compare_rules = options.compare_rules, .report = options.report}),
      .frame = simulate(scene, observer),
      .sampled_force = 0.0,
      .sweep = {},
      .results = {},
      .relaxation = {},
      .course = {},
      .circuit = {}};
  const SceneProblem problem(scene);
  experiment.sampled_force =
      sampled_force(experiment.frame.truth.normal, problem.surface().spacing);
  const SceneFrame frame(problem, experiment.frame.readings);
  const Run run{options, frame.problem(), frame, experiment};
  const remark::Clipped clipped = clipped_for_methods(problem, experiment.frame.readings);
  // What a frame has computed stays with it: a copy is made where taxels are left out alone.
  std::optional<Run> of_rest;
  if (clipped.left_out) {
    const SceneFrame rest = without(frame, clipped.taxels);
    of_rest.emplace(Run{options, rest.problem(), rest, experiment});
  }
  if (experiment.work.does(Computation::rule_comparison)) {
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
  if (experiment.work.does(Computation::time_course))
    if (const auto method = followed(experiment.results))
      experiment.course = time_course(problem, *method, observer);
  return experiment;
}

}  // namespace tactile_net::lab
