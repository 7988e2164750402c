// What the commands take that begin with a scene.
#include "command_line/all_commands.hpp"

namespace tactile_net::tool {

void add_run(AllCommands& all) {
  auto [command, options] = all.add<RunOptions>(
      {.name = "run",
       .text = "Simulate a scene, reconstruct it by every method it names, compare with the truth",
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
                   "Print the plan instead: what is simulated and computed, what is not, and why");
  command.add_flag("--compare-rules", options.compare_rules,
                   "Show every rule for alpha, where the scene gives alpha too");
  command.add_option("--frame", options.frame, number(),
                     "Of a scene with [time]: the frame to reconstruct, from 0 (default: the "
                     "last)");
  add_network(command, options.network);
  add_simulator(command, options.simulator);
}

void add_simulate(AllCommands& all) {
  auto [command, options] = all.add<SimulateOptions>(
      {.name = "simulate",
       .text = "Record what the scene's sensor reads, one frame a row, as solve reads it back",
       .pages = {"scene.md", "results.md"},
       .examples = {{"simulate scenes/effects/sliding.toml -o readings.csv --truth truth.csv",
                     "every frame of a scene over time, and what truly pressed"},
                    {"simulate scenes/fingertip.toml", "one frame, on standard output"}}});
  add_scene(command, options.scene);
  command.add_option("-o,--output", options.output, main_output({"csv", "npy"}),
                     "CSV or .npy file for the readings (default: CSV on standard output)");
  command.add_option(
      "--truth", options.truth, output_file({"csv", "npy"}),
      "CSV or .npy file for the contacts' tractions, where solve finds them [unit of E]");
  add_json(command, options.json, "Write a summary as JSON");
}

void add_identify(AllCommands& all) {
  auto [command, options] = all.add<IdentifyOptions>(
      {.name = "identify",
       .text = "Before any reading: which tractions the scene's sensors can tell apart, and which "
               "others could",
       .pages = {"results.md", "glossary.md"},
       .examples = {
           {"identify scenes/two-strains.toml --out out", "with plots, in out/report.html"},
           {"identify scenes/recorded/thin-pad.toml --traction 5000",
            "detect ripples of 5000 above the noise"}}});
  add_scene(command, options.scene);
  add_results(command, options.results,
              "Folder for report.html, result.json and the plots' data (CSV)",
              "Write the result as JSON");
  command.add_option(
      "--traction", options.survey.traction, number(),
      "Amplitude of the ripples that the sensors are to detect [unit of E] (default: the contacts' "
      "peak)");
  command.add_option("--readings", options.readings, file("FILE", {"csv", "npy"}),
                     "Recorded readings: detect ripples as strong as these");
  add_columns(command, options.columns);
  command.add_option("--noise", options.survey.relative_noise, number(),
                     "Noise of every reading, over the largest that such a ripple causes "
                     "(default: the scene's rms, or 0.01)");
}

void add_tradeoff(AllCommands& all) {
  auto [command, options] = all.add<TradeoffOptions>(
      {.name = "tradeoff",
       .text = "What accuracy costs in time: every method and every circuit, timed on this "
               "machine, and which to choose",
       .pages = {"accuracy.md", "results.md"},
       .examples = {{"tradeoff scenes/thesis/cylinder.toml --out out", "all of it, into out"},
                    {"tradeoff scenes/skins/sphere.toml --out out --resume",
                     "of a skin, and of larger ones; goes on after Ctrl-C"},
                    {"tradeoff scenes/thesis/cylinder.toml --digital --deadline 100us",
                     "without circuits: what is most accurate within 100 us"}}});
  add_scene(command, options.scene);
  add_results(command, options.results,
              "Folder for report.html, tradeoff.csv, tradeoff.json and the plots (SVG, CSV)",
              "Write the study as JSON");
  command.add_option("--deadline", options.deadline, text("TIME"),
                     "A frame must be done within this: 100us, 1ms, ...");
  command.add_option("--accuracy", options.accuracy, number(),
                     "Largest error against the exact solution of the same problem, relative");
  command.add_flag("--digital", options.digital, "Arithmetic only: no circuits, no ngspice");
  command.add_flag("--resume", options.resume,
                   "Go on with the study that was interrupted, in the folder --out");
  add_simulator(command, options.simulator);
}

}  // namespace tactile_net::tool
