// What the commands take that begin with a scene.
#include "command_line/all_commands.hpp"

namespace tactile_net::tool {

void add_run(AllCommands& all) {
  auto [command, options] = all.add<RunOptions>(
      {.name = "run",
       .text = "Simulate a scene, reconstruct it by every method that it names, and compare with "
               "the truth",
       .pages = {"scene.md", "results.md"},
       .examples = {{"run scenes/fingertip.toml --out out",
                     "the page out/report.html, and every "
                     "number in out/result.json"},
                    {"run scenes/fingertip.toml --explain", "what would be computed, and why"},
                    {"run scenes/nic.toml --realization crossbar --json -",
                     "another circuit, as JSON on standard output"}}});
  add_scene(command, options.scene);
  add_results(command, options.results,
              "Folder for report.html, result.json, CSV files and the netlist",
              "Write the result as JSON");
  command.add_flag("--explain", options.explain,
                   "Print only what would be simulated and computed, what would not, and why");
  command.add_flag("--compare-rules", options.compare_rules,
                   "Show every rule for alpha, even if the scene gives alpha");
  command.add_option("--frame", options.frame, number(),
                     "Frame to reconstruct, from 0, of a scene with [time] (default: the last)");
  add_network(command, options.network);
  add_simulator(command, options.simulator);
}

void add_simulate(AllCommands& all) {
  auto [command, options] = all.add<SimulateOptions>(
      {.name = "simulate",
       .text =
           "Write what the scene's sensor reads, one frame a row, in the format that solve reads",
       .pages = {"scene.md", "results.md"},
       .examples = {{"simulate scenes/effects/sliding.toml -o readings.csv --truth truth.csv",
                     "every frame of a scene over time, and the true tractions"},
                    {"simulate scenes/fingertip.toml", "one frame, on standard output"}}});
  add_scene(command, options.scene);
  command.add_option("-o,--output", options.output, main_output({"csv", "npy"}),
                     "CSV or .npy file for the readings (default: CSV on standard output)");
  command.add_option("--truth", options.truth, output_file({"csv", "npy"}),
                     "CSV or .npy file for the contacts' tractions, at the places where solve "
                     "finds them [unit of E]");
  add_json(command, options.json, "Write a summary as JSON");
}

void add_identify(AllCommands& all) {
  auto [command, options] = all.add<IdentifyOptions>(
      {.name = "identify",
       .text = "Compute, before any measurement, which tractions the scene's sensors can tell "
               "apart, and which other sensors could",
       .pages = {"results.md", "glossary.md"},
       .examples = {
           {"identify scenes/two-strains.toml --out out", "with plots, in out/report.html"},
           {"identify scenes/recorded/thin-pad.toml --traction 5000",
            "detect ripples of 5000 above the noise"}}});
  add_scene(command, options.scene);
  add_results(command, options.results,
              "Folder for report.html, result.json and the plots' data (CSV)",
              "Write the result as JSON");
  command.add_option("--traction", options.survey.traction, number(),
                     "Amplitude of the ripples that the sensors must detect [unit of E] (default: "
                     "the contacts' peak)");
  command.add_option(
      "--readings", options.readings, file("FILE", {"csv", "npy"}),
      "Recorded readings (CSV or .npy): the sensors must detect ripples as strong as these");
  add_columns(command, options.columns);
  command.add_option("--noise", options.survey.relative_noise, number(),
                     "Noise of every reading, as a share of the largest reading that such a ripple "
                     "causes (default: the scene's rms, or 0.01)");
}

void add_tradeoff(AllCommands& all) {
  auto [command, options] = all.add<TradeoffOptions>(
      {.name = "tradeoff",
       .text = "Measure what accuracy costs in time: every method and every circuit on this "
               "machine, and which to choose",
       .pages = {"accuracy.md", "results.md"},
       .examples = {{"tradeoff scenes/thesis/cylinder.toml --out out", "all of it, into out"},
                    {"tradeoff scenes/skins/sphere.toml --out out --resume",
                     "for a skin and larger ones; it goes on after Ctrl-C"},
                    {"tradeoff scenes/thesis/cylinder.toml --digital --deadline 100us",
                     "without circuits: the most accurate method within 100 us"}}});
  add_scene(command, options.scene);
  add_results(command, options.results,
              "Folder for report.html, tradeoff.csv, tradeoff.json and the plots' data (CSV)",
              "Write the study as JSON");
  command.add_option("--deadline", options.deadline, text("TIME"),
                     "Longest time for a frame: 100us, 1ms, ...");
  command.add_option("--accuracy", options.accuracy, number(),
                     "Largest relative error against the exact solution of the same problem");
  command.add_flag("--digital", options.digital,
                   "Measure arithmetic only: no circuits, no ngspice");
  command.add_flag("--resume", options.resume,
                   "Continue the interrupted study in the folder of --out");
  add_simulator(command, options.simulator);
}

}  // namespace tactile_net::tool
