#include <iostream>
#include <memory>

#include "commands.hpp"
#include "experiment.hpp"
#include "failure.hpp"
#include "output.hpp"
#include "result_json.hpp"
#include "table.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string realization;
  std::string json;
  SimulatorChoice simulator;
};

void run(Options& options) {
  Scene scene = read_scene(options.scene);
  if (!options.realization.empty())
    scene.network.realization = parse_realization(options.realization);
  const std::unique_ptr<Simulator> simulator = make_simulator(options.simulator);

  Progress progress;
  const CircuitPlan plan = plan_circuit(scene, simulate(scene).readings);
  progress.step("ngspice ...");
  const Relaxation relaxation = relax(plan, *simulator);
  progress.clear();
  if (options.json != "-") print_relaxation(std::cout, relaxation);
  if (!options.json.empty()) {
    OutputFile output(options.json);
    output.stream() << relaxation_json(scene, relaxation);
    output.commit();
  }
  if (!relaxation.agrees())
    throw CheckFailed("the circuit differs from the direct solve by more than rounding explains");
  if (!relaxation.stable)
    throw CheckFailed("P is not positive definite: the circuit would not settle");
}

}  // namespace

void add_relax(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "relax",
      "Run the scene's circuit in ngspice and compare it with the direct solve of P f = b");
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required();
  command->add_option(
      "--realization", options->realization,
      "One of ideal, nic, rail, crossbar, least_squares, lc, ndr (default: the scene's)");
  command->add_option("--json", options->json, "Write the result as JSON (- = standard output)");
  add_simulator_options(*command, options->simulator);
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
