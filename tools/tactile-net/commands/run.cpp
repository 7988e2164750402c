#include "commands/run.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "commands/input.hpp"
#include "failure.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/pages/run_page.hpp"
#include "tactile_net/report/json/run_json.hpp"
#include "tactile_net/report/json/workload_json.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/workload_words.hpp"

namespace tactile_net::tool {
namespace {

/// As the options say; who names a circuit wants to see it.
Scene scene_of(Scene scene, const RunOptions& options, const Streams& streams) {
  if (options.frame) scene = at_frame(std::move(scene), *options.frame);
  apply(options.network, scene.network, streams.err);
  auto& methods = scene.reconstruct.methods;
  if (options.network.any() &&
      std::find(methods.begin(), methods.end(), Method::network) == methods.end())
    methods.push_back(Method::network);
  return scene;
}

/// @param scene  of a line or of a skin
void explain(const auto& scene, const RunOptions& options, const Streams& streams) {
  const lab::Workload work = lab::workload(
      scene, {.compare_rules = options.compare_rules, .report = !options.results.folder.empty()});
  Results results({.json = options.results.json}, streams);
  Progress progress(streams);
  results.write({.print = [&](std::ostream& out) { report::print_workload(out, scene, work); },
                 .json = [&] { return report::workload_json(scene, work); }},
                progress);
}

/// What a skin's run does not do.
void refuse_for_skins(const RunOptions& options) {
  const auto refuse = [](bool given, const char* option, const char* why) {
    if (given) throw WrongUsage(option, std::string(why) + ", and this scene is of a skin");
  };
  refuse(options.compare_rules, "--compare-rules", "compares rules for line arrays");
}

void write_results(const lab::Experiment& experiment, Results& results, Progress& progress,
                   const Streams& streams) {
  results.write({.print = [&](std::ostream& out) { report::print_experiment(out, experiment); },
                 .json = [&] { return report::experiment_json(experiment); },
                 .page = [&] { return pages::run_page(experiment, streams.command); }},
                progress);
}

void run(SkinScene scene, const RunOptions& options, const Streams& streams) {
  refuse_for_skins(options);
  if (options.frame) scene = at_frame(std::move(scene), *options.frame);
  if (options.explain) {
    if (options.network.any())
      throw WrongUsage("--explain",
                       "counts a skin's work without its circuit: leave out its options");
    return explain(scene, options, streams);
  }
  apply(options.network, scene.network, streams.err);
  Results results(options.results, streams);
  Progress progress(streams);
  lab::Experiment experiment = lab::run(scene, lab::monotonic_time, progress);
  if (options.network.any())
    lab::run_circuit(experiment, *lab::make_simulator(options.simulator), progress);
  write_results(experiment, results, progress, streams);
  if (!experiment.succeeded())
    throw CheckFailed(experiment.results.front().has_answer() && options.network.any()
                          ? "the circuit has no answer that holds"
                          : "there is no answer that holds");
}

void run(Scene line, const RunOptions& options, const Streams& streams) {
  const Scene scene = scene_of(std::move(line), options, streams);
  if (options.explain) return explain(scene, options, streams);
  const std::unique_ptr<Simulator> simulator = lab::make_simulator(options.simulator);
  Results results(options.results, streams);
  Progress progress(streams);
  const lab::Experiment experiment = lab::run(scene, *simulator,
                                              {.compare_rules = options.compare_rules,
                                               .report = !options.results.folder.empty(),
                                               .clock = lab::monotonic_time},
                                              progress);
  write_results(experiment, results, progress, streams);
  if (!experiment.succeeded()) throw CheckFailed("not every method has an answer that holds");
}

}  // namespace

void run(const RunOptions& options, const Streams& streams) {
  std::visit([&](auto scene) { run(std::move(scene), options, streams); },
             read_any_scene(options.scene, streams.in));
}

}  // namespace tactile_net::tool
