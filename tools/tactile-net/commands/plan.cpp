#include "commands/plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "commands/deadline.hpp"
#include "commands/input.hpp"
#include "commands/recording.hpp"
#include "commands/results.hpp"
#include "failure.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/numeric/counted.hpp"
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
  if (!(options.share > 0.0) || options.share > 1.0)
    throw WrongUsage("--share", "a frame may take a share above 0 of the deadline, at most 1");
  if (options.steps == 0U) throw WrongUsage("--steps", "a frame takes 1 to 64 steps");
  if (options.friction_limit || options.nonnegative) {
    ConeOptions& cone = planner.cone.emplace();
    cone.constraints.friction_limit = options.friction_limit;
    cone.steps = options.steps.value_or(0);
  } else if (options.steps) {
    throw WrongUsage("--steps",
                     "steps lead towards constraints: give --friction-limit MU or "
                     "--nonnegative");
  }
  return planner;
}

std::size_t readings_of(const Scene& scene) { return reading_count(scene.sensor); }
std::size_t readings_of(const SkinScene& scene) { return reading_count(scene.sensor); }

/// @param calibration  filled with what the recording says of it
template <class Problem>
lab::PlanAlpha alpha_of(const Problem& problem, const PlanOptions& options,
                        std::optional<Calibration>& calibration, const Streams& streams) {
  Progress progress(streams);
  const auto& scene = problem.scene();
  const bool has_baseline = scene.calibration && scene.calibration->baseline_frames;
  if (!options.readings.empty() && (!scene.reconstruct.alpha || has_baseline)) {
    frames::ReadingsFile file(options.readings, scene, &streams.in,
                              {.columns = options.columns, .accept_missing = true});
    say_opening(streams.err, file.name(), file.source());
    bool any = false;
    std::size_t left_out = 0;
    const auto misses = [](double reading) { return std::isnan(reading); };
    const auto next = [&](std::span<double> readings) {
      while (file.source().next(readings)) {
        if (std::none_of(readings.begin(), readings.end(), misses)) return any = true;
        ++left_out;
      }
      return false;
    };
    std::vector<double> first(readings_of(scene));
    if (scene.reconstruct.alpha) (void)next(first);
    const auto alpha = lab::plan_alpha(problem, next, progress);
    if (!any) throw InputError({{.file = options.readings, .message = "holds no whole frame"}});
    if (left_out > 0)
      streams.err << file.name() << ": note: " << counted(left_out, "frame")
                  << (left_out == 1 ? " misses readings and is" : " miss readings and are")
                  << " left out of the choice of alpha\n";
    if (file.calibration() != nullptr) calibration = *file.calibration();
    return *alpha;
  }
  if (const auto alpha = lab::plan_alpha(problem)) return *alpha;
  throw InputError({{.file = options.scene,
                     .message = "has a rule for alpha, but neither a contact nor readings to "
                                "apply it to; a plan has one alpha for all frames",
                     .hint = "set reconstruct.alpha, or pass recorded frames: --readings "
                             "FILE.csv"}});
}

template <class Problem>
void make_plan(const Problem& problem, const PlanOptions& options, const Streams& streams) {
  std::optional<double> deadline;
  if (options.deadline) deadline = deadline_of(*options.deadline);
  PlannerOptions planner = planner_options(options);
  if (problem.constraints() && !planner.cone)
    streams.err << "warning: a plan is linear, and the scene's constraints do not bind it: "
                   "--friction-limit MU or --nonnegative makes one whose frames obey them\n";
  const auto output = output_if(options.output, streams);
  const auto summary = output_if(options.json, streams);

  const lab::PlanAlpha alpha = alpha_of(problem, options, planner.calibration, streams);
  lab::PlannedController planned = lab::plan_controller(problem, alpha, planner);
  planned.force = lab::planned_force(problem, planned.estimator.plan, planner.calibration);
  const EstimatorPlan& plan = planned.estimator.plan;
  const lab::FrameTimes times = lab::frame_times(plan);
  double frame = times.frame;
  if (plan.cone && deadline && options.steps.value_or(0) == 0) {
    const std::size_t before = plan.cone->steps;
    try {
      lab::fit_steps(planned.estimator, times, options.share * *deadline);
    } catch (const std::invalid_argument& error) {
      throw CheckFailed(std::string(error.what()) + "; --share is the deadline's part of it");
    }
    frame -= static_cast<double>(before - plan.cone->steps) * times.step;
  }
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

}  // namespace

void run(const PlanOptions& options, const Streams& streams) {
  check_one_standard_input(options.scene, options.readings);
  AnyScene scene = read_any_scene(options.scene, streams.in);
  if (const auto* skin = std::get_if<SkinScene>(&scene)) {
    if (options.allow_fft || options.structure == Structure::fft)
      throw WrongUsage(options.allow_fft ? "--allow-fft" : "--structure",
                       "an fft is for line arrays, and this scene is of a skin");
    return make_plan(lab::SkinSceneProblem(*skin), options, streams);
  }
  make_plan(lab::SceneProblem(std::get<Scene>(std::move(scene))), options, streams);
}

}  // namespace tactile_net::tool
