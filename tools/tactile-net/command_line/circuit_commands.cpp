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
                     "from parts that are sold, with the tolerance that each needs"},
                    {"gen scenes/nic.toml --subcircuit pad -o pad.lib --symbol pad.asy",
                     "a sub-circuit with pins for the readings, and its symbol"}}});
  add_scene(command, options.scene);
  command.add_option("-o,--output", options.output, main_output({"cir", "lib"}),
                     "Deck (default: standard output)");
  command.add_choice(
      "--dialect", options.dialect, dialects,
      "Simulator that will read the deck; a deck that breaks its rules is not written");
  command.add_option("--budget", options.budget, text("SHARE"),
                     "Use resistors that are sold: the cheapest with which the error of 95 of 100 "
                     "builds is at most this, such as 0.3%; a comment has the tolerance of each");
  command.add_option("--board", options.board, file("FILE", {"kicad_pcb"}),
                     "Load every node with the capacitance of this board's copper");
  command.add_option("--refine", options.refine, text("CYCLE"),
                     "Write the first build that `certify --refine` draws as it answers in this "
                     "cycle of the refinement: in the first to the readings, later to what the "
                     "cycles before have left");
  command.add_option("--subcircuit", options.subcircuit, text("NAME"),
                     "Write a sub-circuit of that name instead of a deck: its pins are the nodes "
                     "into which the readings' currents flow, then the outputs");
  command.add_option("--symbol", options.symbol, output_file({"asy"}),
                     "Write the sub-circuit's symbol for LTspice");
  add_network(command, options.network);
}

void add_relax(AllCommands& all) {
  auto [command, options] = all.add<RelaxOptions>(
      {.name = "relax",
       .text = "Run a circuit in ngspice: a scene's, compared with the direct solve of P f = b, "
               "or a deck (FILE.cir), compared with the voltages that its header expects",
       .pages = {"circuits.md", "strangers.md"},
       .examples = {
           {"relax scenes/nic.toml", "the scene's circuit, compared with the direct solve"},
           {"relax nic.cir --tolerance 1e-6", "a deck that gen wrote; you may have edited it"},
           {"relax scenes/circuits/crossbar.toml --model ths4551.lib",
            "with a vendor's macromodel of the op-amp, against the certificate"}}});
  add_scene(command, options.scene, "Scene file (TOML), or deck (.cir)", {"toml", "cir"});
  add_json(command, options.json, "Write the result as JSON");
  command.add_option("--tolerance", options.tolerance, number(),
                     "For a deck: largest relative difference that passes (default: its `* within` "
                     "line, or 1e-9)");
  command.add_option("--board", options.board, file("FILE", {"kicad_pcb"}),
                     "For a scene: load every node with the capacitance of this board's copper");
  command.add_option("--model", options.model, file("FILE", {"lib", "cir", "txt", "mod"}),
                     "For a scene: a vendor's PSpice macromodel in place of its op-amps; settling "
                     "and stability are compared with the certificate");
  command.add_option("--refine", options.refine, text("KEY=VALUE,..."),
                     "For a scene: refine the first build that `certify --refine` draws, a deck a "
                     "cycle, as the keys of the scene's refine say, such as bits=12,cycles=4; "
                     "compared with the same build in numbers");
  add_network(command, options.network);
  add_simulator(command, options.simulator);
}

void add_certify(AllCommands& all) {
  auto [command, options] = all.add<CertifyOptions>(
      {.name = "certify",
       .text = "Compute, without a simulator, whether the scene's circuit is stable, how fast it "
               "settles, which errors of components it tolerates, and which realisation to choose",
       .pages = {"circuits.md"},
       .examples = {{"certify scenes/circuits/crossbar.toml --out out",
                     "with poles, settling and builds as plots"},
                    {"certify scenes/circuits/board.toml --budget 0.3% --out out",
                     "the parts to order in out/parts.csv, and the board in out/board.kicad_pcb"},
                    {"certify scenes/nic.toml --realization crossbar --bandwidth 10e6",
                     "another circuit, with op-amps of 10 MHz"}}});
  add_scene(command, options.scene);
  add_results(command, options.results,
              "Folder for report.html, certificate.json and the plots' data (CSV)",
              "Write the certificate as JSON");
  command.add_option(
      "--budget", options.budget, text("SHARE"),
      "Find, for each realisation, the cheapest resistors with which the error of "
      "95 of 100 builds is at most this, such as 0.3%; with --out, write parts.csv, "
      "BOM.csv and board.kicad_pcb of the cheapest realisation, and SCENE.ordered.toml, "
      "the scene with its siemens");
  command.add_option("--board", options.board, file("FILE", {"kicad_pcb"}),
                     "Certify the scene's circuit with the capacitance of this board's copper, "
                     "routed or not; --budget does so with the board that it writes");
  command.add_option("--phase-margin", options.phase_margin, number(),
                     "Phase margin in degrees up to which siemens are raised for a board");
  command.add_flag("--oscillating-board", options.oscillating_board,
                   "Write board.kicad_pcb even if the circuit oscillates on it");
  command.add_flag("--datasheet", options.datasheet,
                   "Say what 95 of 100 builds do, from draws that nothing was chosen with: error, "
                   "offset, settling, noise and supply current over tolerances and temperature, "
                   "against the scene's limits; with --budget, of the parts to order; with --out, "
                   "write it as SCENE.datasheet.json too");
  command.add_option("--refine", options.refine, text("KEY=VALUE,..."),
                     "Refine the circuit's answer in numbers, as the keys of the scene's refine "
                     "say, such as bits=12,cycles=4: what is proven, what builds come to, and "
                     "whether it pays");
  add_network(command, options.network);
}

void add_bench(AllCommands& all) {
  auto [command, options] = all.add<BenchOptions>(
      {.name = "bench",
       .text = "Find what is wrong with a built board from its measured responses, and the matrix "
               "that corrects its answers",
       .pages = {"circuits.md"},
       .examples = {{"bench scenes/circuits/bench.toml --simulate board.csv --fault open:Rk3_3p",
                     "the responses of a board with a fault, as an example"},
                    {"bench scenes/circuits/bench.toml board.csv --out out",
                     "the part that is wrong; the correction in out/correction.csv"}}});
  add_scene(command, options.scene);
  command.add_option("MEASURED", options.measured, file("MEASURED", {"csv"}),
                     "CSV of the measured responses: a pattern a row, a current of each input (I0, "
                     "I1, ... [A]), then a voltage of each output (n0, n1, ... [V])");
  command.add_option("--noise", options.noise, number(),
                     "Standard deviation of a voltage [V] (default: of 12 bits)");
  command.add_option("--simulate", options.simulate, output_file({"csv"}),
                     "Write such a file instead of reading one: of a board of the scene's "
                     "tolerances");
  command.add_option("--fault", options.faults, text("KIND:PART,..."),
                     "With --simulate: faults that are planted, such as open:Rk3_3p, "
                     "ten_times:Rs1_2n, swapped:Rk1_2p/Rt0_3n");
  command.add_option("--bits", options.bits, number(),
                     "With --simulate: of the converter (default: 12)");
  command.add_option("--seed", options.seed, number(), "With --simulate: which board (default: 1)");
  add_results(command, options.results, "Folder for report.html, bench.json and correction.csv",
              "Write the result as JSON");
  add_network(command, options.network);
}

}  // namespace tactile_net::tool
