#include <memory>

#include "commands/commands.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/lab/deck_file.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string output;
  NetworkChoice network;
};

void run(const Options& options) {
  lab::refuse_deck(options.scene);
  Scene scene = read_scene(options.scene);
  apply(options.network, scene);
  frames::OutputFile output(options.output);
  output.stream() << lab::deck_text(lab::plan_circuit(scene, lab::simulate(scene).readings),
                                    Answer::printed);
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
  add_network_options(*command, options->network);
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
