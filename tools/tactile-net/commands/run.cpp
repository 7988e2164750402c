#include "tactile_net/lab/run.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>

#include "commands/commands.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/failure.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/report/json/run_json.hpp"
#include "tactile_net/report/json/workload_json.hpp"
#include "tactile_net/report/pages/run_page.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/workload_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  NetworkChoice network;
  std::string folder;
  std::string json;
  lab::SimulatorChoice simulator;
  std::optional<std::size_t> frame;
  bool compare_rules = false;
  bool explain = false;
};

void explain(const Scene& scene, const lab::Workload& work, const std::string& json) {
  if (json != "-") report::print_workload(std::cout, scene, work);
  if (json.empty()) return;
  frames::OutputFile output(json);
  output.stream() << report::workload_json(scene, work);
  output.commit();
}

std::string readings_csv(const lab::Experiment& experiment) {
  std::string text;
  frames::append_header(text, frames::reading_columns(experiment.scene.sensor), false);
  frames::append_row(text, experiment.frame.readings);
  return text;
}

std::string tractions_csv(std::vector<double> normal, std::span<const double> tangential) {
  std::string text;
  frames::append_header(text, frames::traction_columns(normal.size(), !tangential.empty()), false);
  normal.insert(normal.end(), tangential.begin(), tangential.end());
  frames::append_row(text, normal);
  return text;
}

void write_results(const lab::Experiment& experiment, const frames::OutputFolder& folder) {
  const TractionField& truth = experiment.frame.truth;
  folder.write("result.json", report::experiment_json(experiment));
  folder.write("readings.csv", readings_csv(experiment));
  folder.write("truth.csv", tractions_csv(truth.normal, truth.tangential));
  for (const lab::MethodResult& result : experiment.results)
    if (result.has_answer())
      folder.write("tractions-" + std::string(name(result.method)) + ".csv",
                   tractions_csv(result.normal.traction, result.tangential.traction));
  if (!experiment.deck.empty()) folder.write("network.cir", experiment.deck);
  write(folder, report::report_html(experiment));
}

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void run(Options& options) {
  Scene scene = read_scene(options.scene);
  if (options.frame) scene = at_frame(std::move(scene), *options.frame);
  apply(options.network, scene);
  auto& methods = scene.reconstruct.methods;  // who names a circuit wants to see it
  if ((!options.network.realization.empty() || options.network.bandwidth) &&
      std::find(methods.begin(), methods.end(), Method::network) == methods.end())
    methods.push_back(Method::network);
  if (options.explain) {
    explain(scene,
            lab::workload(
                scene, {.compare_rules = options.compare_rules, .report = !options.folder.empty()}),
            options.json);
    return;
  }
  const std::unique_ptr<Simulator> simulator = lab::make_simulator(options.simulator);
  std::unique_ptr<frames::OutputFolder> folder;
  if (!options.folder.empty()) folder = std::make_unique<frames::OutputFolder>(options.folder);

  Progress progress;
  const lab::Experiment experiment = lab::run(
      scene, *simulator,
      {.compare_rules = options.compare_rules, .report = folder != nullptr, .clock = seconds},
      progress);
  if (folder) {
    progress.say("drawing the report ...");
    write_results(experiment, *folder);
    folder->commit();
  }
  progress.clear();

  if (options.json != "-") report::print_experiment(std::cout, experiment);
  if (!options.json.empty()) {
    frames::OutputFile output(options.json);
    output.stream() << report::experiment_json(experiment);
    output.commit();
  }
  if (folder && options.json != "-")
    std::cout << "report: " << (std::filesystem::path(options.folder) / "report.html").string()
              << '\n';
  std::cout.flush();
  if (!experiment.succeeded())
    throw frames::CheckFailed("not every method has an answer that holds");
}

}  // namespace

void add_run(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "run", "Simulate a scene, reconstruct it by every method it names, compare with the truth");
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required();
  command->add_option("--out", options->folder,
                      "Folder for report.html, result.json, CSV files and the netlist");
  command->add_option("--json", options->json, "Write the result as JSON (- = standard output)");
  command->add_flag("--explain", options->explain,
                    "Print the plan instead: what is simulated and computed, what is not, and why");
  command->add_flag("--compare-rules", options->compare_rules,
                    "Show every rule for alpha, where the scene gives alpha too");
  command->add_option("--frame", options->frame,
                      "Of a scene with [time]: the frame to reconstruct, from 0 (default: the "
                      "last)");
  add_network_options(*command, options->network);
  add_simulator_options(*command, options->simulator);
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
