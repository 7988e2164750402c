// What the commands take that are about a circuit.
#include "command_line/all_commands.hpp"

namespace tactile_net::tool {

void add_gen(AllCommands& all) {
  auto [command, options] = all.add<GenOptions>(
      {.name = "gen",
       .text = "Write the scene's circuit as a SPICE deck; `ngspice -b FILE.cir` prints its "
               "voltages",
       .pages = {"circuits.md"},
       .examples = {{"gen scenes/nic.toml -o nic.cir", "the circuit that the scene asks for"},
                    {"gen scenes/circuits/board.toml --budget 0.3% -o board.cir",
                     "of parts that are sold, and how exact each must be"},
                    {"gen scenes/nic.toml --subcircuit pad -o pad.lib --symbol pad.asy",
                     "a sub-circuit with pins for the readings, and its symbol"}}});
  add_scene(command, options.scene);
  command.add_option("-o,--output", options.output, main_output({"cir", "lib"}),
                     "Deck (default: standard output)");
  command.add_choice(
      "--dialect", options.dialect, dialects,
      "The simulator that is to read it; a deck that breaks its rules is not written");
  command.add_option(
      "--budget", options.budget, text("SHARE"),
      "Of resistors that are sold, the cheapest with which 95 of 100 builds err by at "
      "most this, such as 0.3%, each with its tolerance as a comment");
  command.add_option("--subcircuit", options.subcircuit, text("NAME"),
                     "In place of a deck a sub-circuit of that name: its pins are the nodes that "
                     "readings' currents flow into, then the outputs");
  command.add_option("--symbol", options.symbol, output_file({"asy"}),
                     "Symbol of the sub-circuit for LTspice");
  add_network(command, options.network);
}

void add_relax(AllCommands& all) {
  auto [command, options] = all.add<RelaxOptions>(
      {.name = "relax",
       .text = "Run a circuit in ngspice: a scene's, compared with the direct solve of P f = b, "
               "or a deck (FILE.cir), compared with the voltages that its header expects",
       .pages = {"circuits.md", "strangers.md"},
       .examples = {{"relax scenes/nic.toml", "the scene's circuit beside the direct solve"},
                    {"relax scenes/circuits/crossbar.toml --simulator library",
                     "by ngspice's library, without starting the program"},
                    {"relax nic.cir --tolerance 1e-6",
                     "a deck that gen wrote, perhaps edited "
                     "since"}}});
  add_scene(command, options.scene, "Scene file (TOML), or deck (.cir)", {"toml", "cir"});
  add_json(command, options.json, "Write the result as JSON");
  command.add_option("--tolerance", options.tolerance, number(),
                     "For a deck: largest relative difference that counts as agreement (default: "
                     "its `* within` line, or 1e-9)");
  add_network(command, options.network);
  add_simulator(command, options.simulator);
}

void add_certify(AllCommands& all) {
  auto [command, options] = all.add<CertifyOptions>(
      {.name = "certify",
       .text = "Say, without a simulator, whether the scene's circuit is stable, how fast it "
               "settles, which errors of components it tolerates, and which realisation to choose",
       .pages = {"circuits.md"},
       .examples = {{"certify scenes/circuits/crossbar.toml --out out",
                     "with poles, settling and builds as plots"},
                    {"certify scenes/circuits/board.toml --budget 0.3% --out out",
                     "what to order for it in out/parts.csv, and the board in out/board.kicad_pcb"},
                    {"certify scenes/nic.toml --realization crossbar --bandwidth 10e6",
                     "another circuit, of op-amps of 10 MHz"}}});
  add_scene(command, options.scene);
  add_results(command, options.results,
              "Folder for report.html, certificate.json and the plots' data (CSV)",
              "Write the certificate as JSON");
  command.add_option(
      "--budget", options.budget, text("SHARE"),
      "The cheapest resistors with which 95 of 100 builds err by at most this, such "
      "as 0.3%, for each realisation; with --out, of the cheapest: parts.csv to order "
      "from, BOM.csv, board.kicad_pcb");
  add_network(command, options.network);
}

}  // namespace tactile_net::tool
