#include <cmath>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "deck_file.hpp"
#include "experiment.hpp"
#include "failure.hpp"
#include "output.hpp"
#include "result_json.hpp"
#include "table.hpp"
#include "tactile_net/scene/reader.hpp"
#include "text.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string json;
  std::optional<double> tolerance;
  NetworkChoice network;
  SimulatorChoice simulator;
};

void write_json(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  OutputFile output(path);
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
  progress.step("ngspice ...");
  DeckAnswer answer = relax_deck(options.scene, simulator);
  answer.within = options.tolerance.value_or(answer.within);
  progress.clear();
  if (options.json != "-") print_deck_answer(std::cout, options.scene, answer);
  write_json(options.json, deck_answer_json(options.scene, answer));
  if (!(answer.difference <= answer.within))
    throw CheckFailed("the deck's voltages differ from those its header expects by " +
                      brief(answer.difference) + " (allowed: " + brief(answer.within) + ")");
}

void run_scene(const Options& options, Simulator& simulator) {
  if (options.tolerance)
    throw CLI::ValidationError("--tolerance",
                               "is for decks; a scene's circuit is judged by what "
                               "its parts explain");
  Scene scene = read_scene(options.scene);
  apply(options.network, scene);
  Progress progress;
  const CircuitPlan plan = plan_circuit(scene, simulate(scene).readings);
  const Relaxation relaxation = relax(plan, simulator, progress);
  progress.clear();
  if (options.json != "-") print_relaxation(std::cout, relaxation);
  write_json(options.json, relaxation_json(scene, relaxation));
  if (const std::string failure = relaxation.failure(); !failure.empty())
    throw CheckFailed(failure);
}

void run(const Options& options) {
  const std::unique_ptr<Simulator> simulator = make_simulator(options.simulator);
  if (is_deck(options.scene))
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
