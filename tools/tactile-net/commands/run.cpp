#include "commands/run.hpp"

#include <algorithm>

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
Scene scene_of(const RunOptions& options, const Streams& streams) {
  Scene scene = read_scene(options.scene, streams.in);
  if (options.frame) scene = at_frame(std::move(scene), *options.frame);
  apply(options.network, scene, streams.err);
  auto& methods = scene.reconstruct.methods;
  if (options.network.any() &&
      std::find(methods.begin(), methods.end(), Method::network) == methods.end())
    methods.push_back(Method::network);
  return scene;
}

void explain(const Scene& scene, const RunOptions& options, const Streams& streams) {
  const lab::Workload work = lab::workload(
      scene, {.compare_rules = options.compare_rules, .report = !options.results.folder.empty()});
  Results results({.json = options.results.json}, streams);
  Progress progress(streams);
  results.write({.print = [&](std::ostream& out) { report::print_workload(out, scene, work); },
                 .json = [&] { return report::workload_json(scene, work); }},
                progress);
}

}  // namespace

void run(const RunOptions& options, const Streams& streams) {
  const Scene scene = scene_of(options, streams);
  if (options.explain) return explain(scene, options, streams);
  const std::unique_ptr<Simulator> simulator = lab::make_simulator(options.simulator);
  Results results(options.results, streams);
  Progress progress(streams);
  const lab::Experiment experiment = lab::run(scene, *simulator,
                                              {.compare_rules = options.compare_rules,
                                               .report = !options.results.folder.empty(),
                                               .clock = lab::monotonic_time},
                                              progress);
  results.write({.print = [&](std::ostream& out) { report::print_experiment(out, experiment); },
                 .json = [&] { return report::experiment_json(experiment); },
                 .page = [&] { return pages::run_page(experiment, streams.command); }},
                progress);
  if (!experiment.succeeded()) throw CheckFailed("not every method has an answer that holds");
}

}  // namespace tactile_net::tool
