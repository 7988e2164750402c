#include <memory>

#include "commands.hpp"
#include "experiment.hpp"
#include "output.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string output;
  std::string realization;
};

void run(const Options& options) {
  Scene scene = read_scene(options.scene);
  if (!options.realization.empty())
    scene.network.realization = parse_realization(options.realization);
  OutputFile output(options.output);
  const CircuitPlan plan = plan_circuit(scene, simulate(scene).readings);
  write_deck(output.stream(), plan.circuit, plan.header, Answer::printed);
  output.commit();
}

}  // namespace

void add_gen(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "gen",
      "Write the scene's circuit as a SPICE deck; `ngspice -b FILE.cir` prints its voltages");
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required();
  command->add_option("-o,--output", options->output, "Deck (default: standard output)");
  command->add_option(
      "--realization", options->realization,
      "One of ideal, nic, rail, crossbar, least_squares, lc, ndr (default: the scene's)");
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
