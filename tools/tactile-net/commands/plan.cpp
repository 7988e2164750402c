#include "commands/plan.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <ostream>

#include "commands/deadline.hpp"
#include "commands/results.hpp"
#include "failure.hpp"
#include "report/json/values.hpp"
#include "tactile_net/control/fftw_convolution.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/scene_parts.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {
namespace {

struct Alpha {
  double value = 0.0;
  std::string source;
};

/// The middle of what the scene's rule chooses on recorded frames: a plan has one alpha for all.
Alpha alpha_of_frames(const Scene& scene, const std::string& path, const Streams& streams) {
  frames::ReadingsFile file(path, scene, &streams.in);
  const InverseProblem problem = lab::problem_of(scene);
  const TikhonovFamily family(problem);
  std::vector<double> readings(problem.kernel.rows);
  std::vector<double> alphas;
  Progress progress(streams);
  while (file.source().next(readings)) {
    alphas.push_back(choose_alpha(family.analyse(readings), scene.reconstruct.alpha_rule,
                                  lab::stated_noise(scene))
                         .alpha);
    if (progress.due()) progress.say("alpha: " + std::to_string(alphas.size()) + " frames ...");
  }
  if (alphas.empty()) throw InputError({{.file = path, .message = "holds no frame"}});
  const auto middle = alphas.begin() + std::ssize(alphas) / 2;
  std::nth_element(alphas.begin(), middle, alphas.end());
  return {*middle, std::string(name(scene.reconstruct.alpha_rule)) + ", the median of " +
                       std::to_string(alphas.size()) + " frames"};
}

Alpha alpha_of(const Scene& scene, const PlanOptions& options, const Streams& streams) {
  if (scene.reconstruct.alpha) return {*scene.reconstruct.alpha, "given"};
  if (!options.readings.empty()) return alpha_of_frames(scene, options.readings, streams);
  if (scene.contacts.empty())
    throw InputError({{.file = options.scene,
                       .message = "has a rule for alpha, but neither a contact nor readings to "
                                  "apply it to; a plan has one alpha for all frames",
                       .hint = "set reconstruct.alpha, or pass recorded frames: --readings "
                               "FILE.csv"}});
  const AlphaRule rule = scene.reconstruct.alpha_rule;
  return {lab::SceneFrame(lab::SceneProblem(scene), lab::simulate(scene).readings).alpha().value,
          std::string(name(rule)) + ", on the scene's own contact"};
}

template <class Enum>
std::optional<Enum> named(const std::string& text, const char* option,
                          std::initializer_list<Enum> all) {
  if (text.empty()) return std::nullopt;
  std::string known;
  for (const Enum one : all) {
    if (name(one) == text) return one;
    known += (known.empty() ? "" : ", ") + std::string(name(one));
  }
  throw WrongUsage(option, "'" + text + "' is none of " + known);
}

/// What a frame of the plan takes on this machine.
lab::Seconds frame_of(const EstimatorPlan& plan) {
  const lab::Pinned pinned;
  ContactEstimator estimator(plan, fftw_convolutions());
  const std::vector<double> readings(plan.readings(), 1.0);
  std::vector<double> tractions(plan.tractions());
  ContactEstimate estimate;
  estimate.tractions = tractions;
  return lab::time_of([&] { (void)estimator.update(readings, estimate); });
}

}  // namespace

void run(const PlanOptions& options, const Streams& streams) {
  std::optional<double> deadline;
  if (options.deadline) deadline = deadline_of(*options.deadline);
  const Scene scene = read_scene(options.scene);
  using enum Structure;
  PlannerOptions planner;
  planner.accuracy = options.accuracy;
  planner.structure =
      named(options.structure, "--structure", {dense, low_rank, parity, parity_low_rank, fft});
  planner.precision =
      named(options.precision, "--precision", {Precision::float64, Precision::float32});
  planner.diagnostics = !options.no_diagnostics;
  planner.allow_fft = options.allow_fft;
  planner.noise_rms = lab::stated_noise(scene).value_or(0.0);
  planner.friction_coefficient = options.friction;
  if (!planner.friction_coefficient)
    planner.friction_coefficient = scene.reconstruct.friction_limit;
  if (scene.quantization)
    planner.ranges.assign(channel_count(scene.sensor),
                          {scene.quantization->low, scene.quantization->high});
  planner.label = scene.title.empty() ? scene.file : scene.title;
  if (lab::constraints_of(scene))
    streams.err << "warning: a plan is linear: nonnegative and friction_limit do not bind it\n";

  const auto output = output_if(options.output, streams);
  const auto summary = output_if(options.json, streams);
  const Alpha alpha = alpha_of(scene, options, streams);
  const PlannedEstimator planned = plan_estimator(lab::problem_of(scene), alpha.value, planner);
  const EstimatorPlan& plan = planned.plan;
  std::ostream& out = options.output == "-" || options.json == "-" ? streams.err : streams.out;
  out << plan.label << ": " << plan.readings() << " readings to " << plan.tractions()
      << " tractions, alpha " << brief(plan.alpha) << " (" << alpha.source << ")\n"
      << planned.why();
  if (plan.prediction)
    out << "  residual, outliers, dead taxels: " << streamed_bytes(*plan.prediction)
        << " bytes a frame more (--no-diagnostics leaves them out)\n";
  const lab::Seconds frame = frame_of(plan);
  out << "  a frame takes " << duration(frame.median) << " here";
  if (deadline) out << ": " << brief(*deadline / frame.median) << " times inside the deadline";
  out << '\n';
  if (deadline && frame.median > *deadline)
    throw CheckFailed("the fastest plan of accuracy " + brief(options.accuracy) + " takes " +
                      duration(frame.median) + ", the deadline is " + duration(*deadline) +
                      ": raise --accuracy" +
                      (plan.prediction ? ", or leave the residual out: --no-diagnostics" : "") +
                      "; tradeoff tells what each method takes");
  if (output) {
    const std::vector<std::byte> bytes = encode_plan(plan);
    output->stream().write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    output->commit();
    out << "plan: " << options.output << ", " << bytes.size() << " bytes\n";
  }
  if (options.json.empty()) return;
  report::Json candidates = report::Json::array();
  for (const Candidate& candidate : planned.candidates)
    candidates.push_back({{"structure", name(candidate.structure)},
                          {"precision", name(candidate.precision)},
                          {"ranks", candidate.ranks},
                          {"transform_size", candidate.transform_size},
                          {"bytes", candidate.bytes},
                          {"error_bound", candidate.error_bound},
                          {"accurate", candidate.accurate},
                          {"chosen", candidate.chosen}});
  summary->stream() << report::text_of(report::Json{{"tactile_net", version()},
                                                    {"scene", scene.file},
                                                    {"readings", plan.readings()},
                                                    {"tractions", plan.tractions()},
                                                    {"alpha", plan.alpha},
                                                    {"alpha_rule", alpha.source},
                                                    {"accuracy", plan.accuracy},
                                                    {"error_bound", plan.error_bound},
                                                    {"asymmetry", planned.asymmetry},
                                                    {"frame_seconds", frame.median},
                                                    {"candidates", std::move(candidates)}},
                                       2);
  summary->commit();
}

}  // namespace tactile_net::tool
