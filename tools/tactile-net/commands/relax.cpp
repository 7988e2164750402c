#include <cmath>
#include <iostream>
#include <memory>

#include "commands/commands.hpp"
#include "tactile_net/frames/failure.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/lab/deck_file.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/json/run_json.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/reader.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string json;
  std::optional<double> tolerance;
  NetworkChoice network;
  lab::SimulatorChoice simulator;
};

void write_json(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  frames::OutputFile output(path);
  output.stream() << text;
  output.commit();
}

void run_deck(const Options& options, Simulator& simulator) {
  if (!options.network.realization.empty() || options.network.bandwidth)
    throw CLI::ValidationError("--realization, --bandwidth",
                               "a deck is what it is; these are for scenes");
  if (options.tolerance && !(*options.tolerance >= 0.0 && std::isfinite(*options.tolerance)))
    throw CLI::ValidationError("--tolerance", "must be >= 0 and finite");
  Progress progress;
  progress.say("ngspice ...");
  lab::DeckAnswer answer = lab::relax_deck(options.scene, simulator);
  answer.within = options.tolerance.value_or(answer.within);
  progress.clear();
  if (options.json != "-") report::print_deck_answer(std::cout, options.scene, answer);
  write_json(options.json, report::deck_answer_json(options.scene, answer));
  if (!(answer.difference <= answer.within))
    throw frames::CheckFailed("the deck's voltages differ from those its header expects by " +
                              brief(answer.difference) + " (allowed: " + brief(answer.within) +
                              ")");
}

void run_scene(const Options& options, Simulator& simulator) {
  if (options.tolerance)
    throw CLI::ValidationError("--tolerance",
                               "is for decks; a scene's circuit is judged by what "
                               "its parts explain");
  Scene scene = read_scene(options.scene);
  apply(options.network, scene);
  Progress progress;
  const lab::CircuitPlan plan = lab::plan_circuit(scene, lab::simulate(scene).readings);
  const lab::Relaxation relaxation = lab::relax(plan, simulator, progress);
  progress.clear();
  if (options.json != "-") report::print_relaxation(std::cout, relaxation);
  write_json(options.json, report::relaxation_json(scene, relaxation));
  if (const std::string failure = relaxation.failure(); !failure.empty())
    throw frames::CheckFailed(failure);
}

void run(const Options& options) {
  const std::unique_ptr<Simulator> simulator = lab::make_simulator(options.simulator);
  if (lab::is_deck(options.scene))
    run_deck(options, *simulator);
  else
    run_scene(options, *simulator);
}

}  // namespace

void add_relax(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "relax",
      "Run a circuit in ngspice: a scene's, compared with the direct solve of P f = b, or a deck "
      "(FILE.cir), compared with the voltages that its header expects");
  command->add_option("SCENE", options->scene, "Scene file (TOML), or deck (.cir)")->required();
  command->add_option("--json", options->json, "Write the result as JSON (- = standard output)");
  command->add_option("--tolerance", options->tolerance,
                      "For a deck: largest relative difference that counts as agreement (default: "
                      "its `* within` line, or 1e-9)");
  add_network_options(*command, options->network);
  add_simulator_options(*command, options->simulator);
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
