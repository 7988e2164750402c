#include "commands/plan.hpp"

#include <optional>
#include <ostream>

#include "commands/deadline.hpp"
#include "commands/input.hpp"
#include "commands/recording.hpp"
#include "commands/results.hpp"
#include "failure.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tactile_net/report/json/controller_json.hpp"
#include "tactile_net/report/words/controller_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::tool {
namespace {

PlannerOptions planner_options(const PlanOptions& options) {
  PlannerOptions planner;
  planner.accuracy = options.accuracy;
  planner.structure = options.structure;
  planner.precision = options.precision;
  planner.diagnostics = !options.no_diagnostics;
  planner.allow_fft = options.allow_fft;
  planner.friction_coefficient = options.friction;
  return planner;
}

lab::PlanAlpha alpha_of(const lab::SceneProblem& problem, const PlanOptions& options,
                        const Streams& streams) {
  Progress progress(streams);
  if (!options.readings.empty() && !problem.scene().reconstruct.alpha) {
    frames::ReadingsFile file(options.readings, problem.scene(), &streams.in,
                              {.columns = options.columns});
    say_opening(streams.err, file.name(), file.source());
    const auto next = [&](std::span<double> readings) { return file.source().next(readings); };
    if (const auto alpha = lab::plan_alpha(problem, next, progress)) return *alpha;
    throw InputError({{.file = options.readings, .message = "holds no frame"}});
  }
  if (const auto alpha = lab::plan_alpha(problem)) return *alpha;
  throw InputError({{.file = options.scene,
                     .message = "has a rule for alpha, but neither a contact nor readings to "
                                "apply it to; a plan has one alpha for all frames",
                     .hint = "set reconstruct.alpha, or pass recorded frames: --readings "
                             "FILE.csv"}});
}

/// What a frame of the plan takes on this machine [s].
double seconds_of_frame(const EstimatorPlan& plan) {
  const lab::Pinned pinned;
  ContactEstimator estimator(plan, fft_convolutions());
  const std::vector<double> readings(plan.readings(), 1.0);
  std::vector<double> tractions(plan.tractions());
  ContactEstimate estimate;
  estimate.tractions = tractions;
  return lab::time_of([&] { (void)estimator.update(readings, estimate); }).median;
}

}  // namespace

void run(const PlanOptions& options, const Streams& streams) {
  check_one_standard_input(options.scene, options.readings);
  std::optional<double> deadline;
  if (options.deadline) deadline = deadline_of(*options.deadline);
  const lab::SceneProblem problem(read_scene(options.scene, streams.in));
  const PlannerOptions planner = planner_options(options);
  if (problem.constraints())
    streams.err << "warning: a plan is linear: nonnegative and friction_limit do not bind it\n";
  const auto output = output_if(options.output, streams);
  const auto summary = output_if(options.json, streams);

  const lab::PlannedController planned =
      lab::plan_controller(problem, alpha_of(problem, options, streams), planner);
  const EstimatorPlan& plan = planned.estimator.plan;
  const double frame = seconds_of_frame(plan);
  std::ostream& out = options.output == "-" || options.json == "-" ? streams.err : streams.out;
  report::print_controller(out, planned, frame, deadline);
  if (deadline && frame > *deadline)
    throw CheckFailed(report::deadline_missed_in_words(planned, frame, *deadline));
  if (output) {
    const std::vector<std::byte> bytes = encode_plan(plan);
    write(output.get(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    out << "plan: " << printable(options.output) << ", " << bytes.size() << " bytes\n";
  }
  if (summary) write(summary.get(), report::controller_json(problem.scene(), planned, frame));
}

}  // namespace tactile_net::tool
