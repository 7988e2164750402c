// The one file that knows the parser.
#include "options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "failure.hpp"
#include "tactile_net/numeric/fft.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/report/words/confinement_words.hpp"
#include "tactile_net/scene/nearest.hpp"

namespace tactile_net::tool {
namespace {

/// The sub-commands, and the options of the one that was named.
struct Parser {
  CLI::App app{
      "Surface tractions from buried tactile sensors, in software and as a circuit.\n"
      "Any consistent set of units; results on standard output, messages on standard error.\n"
      "Exit status: 0 done, 1 a computation or a check failed, 2 wrong usage or bad input.",
      "tactile-net"};
  std::optional<Command> command{};

  template <class Options>
  std::pair<CLI::App*, std::shared_ptr<Options>> add(const std::string& name,
                                                     const std::string& description) {
    const auto options = std::make_shared<Options>();
    CLI::App* sub = app.add_subcommand(name, description);
    sub->callback([this, options] { command = *options; });
    return {sub, options};
  }
};

void add_simulator(CLI::App& command, lab::SimulatorChoice& choice) {
  command
      .add_option("--simulator", choice.kind,
                  "How to run ngspice: process starts the program for each circuit; library loads "
                  "ngspice once, in a process of its own, which is faster for small circuits")
      ->capture_default_str();
  command
      .add_option("--ngspice", choice.ngspice.program,
                  "The simulator's program, for --simulator process")
      ->capture_default_str();
  command.add_option("--time-limit", choice.time_limit, "Longest run of the simulator [s]")
      ->capture_default_str();
}

void add_network(CLI::App& command, NetworkOptions& network) {
  command.add_option("--realization", network.realization,
                     "Build the circuit as ideal, nic, rail, crossbar, least_squares, lc or ndr "
                     "(default: the scene's)");
  command.add_option("--bandwidth", network.bandwidth,
                     "Gain-bandwidth product of the op-amps [Hz]; asks for the settling time too");
}

void add_scene(CLI::App& command, std::string& scene,
               const std::string& description = "Scene file (TOML)") {
  command.add_option("SCENE", scene, description)->required();
}

void add_columns(CLI::App& command, std::string& columns) {
  command.add_option(
      "--columns", columns,
      "Where the readings stand in a row, in their order: numbers of columns from 1, "
      "ranges or names, as 2-42, or t=1,4-44 with the times in column 1 (default: "
      "found by the names in the header)");
}

void add_results(CLI::App& command, ResultOptions& results, const std::string& folder,
                 const std::string& json) {
  command.add_option("--out", results.folder, folder);
  command.add_option("--json", results.json, json + " (- = standard output)");
}

void add_run(Parser& parser) {
  const auto [command, options] = parser.add<RunOptions>(
      "run", "Simulate a scene, reconstruct it by every method it names, compare with the truth");
  add_scene(*command, options->scene);
  add_results(*command, options->results,
              "Folder for report.html, result.json, CSV files and the netlist",
              "Write the result as JSON");
  command->add_flag("--explain", options->explain,
                    "Print the plan instead: what is simulated and computed, what is not, and why");
  command->add_flag("--compare-rules", options->compare_rules,
                    "Show every rule for alpha, where the scene gives alpha too");
  command->add_option("--frame", options->frame,
                      "Of a scene with [time]: the frame to reconstruct, from 0 (default: the "
                      "last)");
  add_network(*command, options->network);
  add_simulator(*command, options->simulator);
}

void add_gen(Parser& parser) {
  const auto [command, options] = parser.add<GenOptions>(
      "gen",
      "Write the scene's circuit as a SPICE deck; `ngspice -b FILE.cir` prints its voltages");
  add_scene(*command, options->scene);
  command->add_option("-o,--output", options->output, "Deck (default: standard output)");
  add_network(*command, options->network);
}

void add_relax(Parser& parser) {
  const auto [command, options] = parser.add<RelaxOptions>(
      "relax",
      "Run a circuit in ngspice: a scene's, compared with the direct solve of P f = b, or a deck "
      "(FILE.cir), compared with the voltages that its header expects");
  add_scene(*command, options->scene, "Scene file (TOML), or deck (.cir)");
  command->add_option("--json", options->json, "Write the result as JSON (- = standard output)");
  command->add_option("--tolerance", options->tolerance,
                      "For a deck: largest relative difference that counts as agreement (default: "
                      "its `* within` line, or 1e-9)");
  add_network(*command, options->network);
  add_simulator(*command, options->simulator);
}

void add_certify(Parser& parser) {
  const auto [command, options] = parser.add<CertifyOptions>(
      "certify",
      "Say, without a simulator, whether the scene's circuit is stable, how fast it settles, which "
      "errors of components it bears, and which realisation to choose");
  add_scene(*command, options->scene);
  add_results(*command, options->results,
              "Folder for report.html, certificate.json and the plots' data (CSV)",
              "Write the certificate as JSON");
  add_network(*command, options->network);
}

void add_simulate(Parser& parser) {
  const auto [command, options] = parser.add<SimulateOptions>(
      "simulate", "Record what the scene's sensor reads, one frame a row, as solve reads it back");
  add_scene(*command, options->scene);
  command->add_option("-o,--output", options->output,
                      "CSV or .npy file for the readings (default: CSV on standard output)");
  command->add_option("--truth", options->truth,
                      "CSV or .npy file for the contacts' tractions at the taxels [Pa]");
  command->add_option("--json", options->json, "Write a summary as JSON to this file");
}

void add_solve(Parser& parser) {
  const auto [command, options] = parser.add<SolveOptions>(
      "solve", "Turn recorded readings, one frame a row, into tractions, one frame a row");
  add_scene(*command, options->scene, "Scene file (TOML): sensor, material, alpha");
  command
      ->add_option("--readings", options->readings,
                   "CSV file with a header (columns such as stress_x_0), or .npy of shape (frames, "
                   "readings); - reads standard input and writes each frame as it comes")
      ->required();
  command->add_option("--method", options->method, "dft, tikhonov or closed_form")
      ->capture_default_str();
  command->add_option("-o,--output", options->output,
                      "CSV or .npy file for the tractions [Pa] (default: CSV on standard output)");
  command->add_option("--out", options->folder,
                      "Folder for report.html, the page of the recording; result.json, shown.csv "
                      "(the frames in its pictures) and, without -o, tractions.csv");
  command->add_option("--uncertainty", options->uncertainty,
                      "CSV file for each frame's forces, centre and angle with their standard "
                      "deviations, the deviation of every traction, alpha and the verdict");
  add_columns(*command, options->columns);
  command
      ->add_option(
          "--missing", options->missing,
          "Where a reading is missing (empty, NaN, NA): fail; skip the frame, whose row is "
          "then empty; or estimate it from the other taxels, as if those without a "
          "reading were dead")
      ->capture_default_str();
  command->add_option("--json", options->json, "Write a summary as JSON to this file");
}

void add_identify(Parser& parser) {
  const auto [command, options] = parser.add<IdentifyOptions>(
      "identify",
      "Before any reading: which tractions the scene's sensors can tell apart, and which others "
      "could");
  add_scene(*command, options->scene);
  add_results(*command, options->results,
              "Folder for report.html, result.json and the plots' data (CSV)",
              "Write the result as JSON");
  command->add_option("--traction", options->survey.traction,
                      "Amplitude of the ripple to be told (default: the contacts' peak)");
  command->add_option("--readings", options->readings,
                      "Recorded readings: ripples as strong as these are to be told");
  add_columns(*command, options->columns);
  command->add_option("--noise", options->survey.relative_noise,
                      "Noise of every reading, over the largest that such a ripple causes "
                      "(default: the scene's rms, or 0.01)");
}

void add_plan(Parser& parser) {
  const auto [command, options] = parser.add<PlanOptions>(
      "plan",
      "Make the plan that a controller loads: how to solve a frame fastest for a stated "
      "accuracy, and why so");
  add_scene(*command, options->scene, "Scene file (TOML): sensor, material, alpha");
  command->add_option("-o,--output", options->output,
                      "Plan file, to be read by load_plan (default: only say what it would be)");
  command
      ->add_option("--accuracy", options->accuracy,
                   "Largest error, relative to the tractions, of the planned against the dense "
                   "product")
      ->capture_default_str();
  command->add_option("--deadline", options->deadline,
                      "A frame must be done within this on this machine: 100us, 1ms, ...");
  command->add_option("--readings", options->readings,
                      "Recorded frames (CSV): the scene's rule for alpha is applied to each, and "
                      "the median taken");
  add_columns(*command, options->columns);
  command->add_option("--friction", options->friction,
                      "Friction coefficient for the friction margin (default: the scene's "
                      "friction_limit)");
  command->add_option("--structure", options->structure,
                      "dense, low_rank, parity, parity_low_rank or fft (default: the cheapest)");
  command->add_option("--precision", options->precision,
                      "float64 or float32 (default: the cheapest)");
  command->add_flag("--allow-fft", options->allow_fft,
                    "Offer fft too, for long arrays: the controller then links "
                    "tactile_net::spectral (GPL where that was built with FFTW)");
  command->add_flag("--no-diagnostics", options->no_diagnostics,
                    "No residual, no outliers, no dead taxels at run time: faster");
  command->add_option("--json", options->json, "Write the choice as JSON (- = standard output)");
}

void add_tradeoff(Parser& parser) {
  const auto [command, options] = parser.add<TradeoffOptions>(
      "tradeoff",
      "What accuracy costs in time: every method and every circuit, timed on this "
      "machine, and which to choose");
  add_scene(*command, options->scene);
  add_results(*command, options->results,
              "Folder for report.html, tradeoff.csv, tradeoff.json and the plots (SVG, CSV)",
              "Write the study as JSON");
  command->add_option("--deadline", options->deadline,
                      "A frame must be done within this: 100us, 1ms, ...");
  command->add_option("--accuracy", options->accuracy,
                      "Largest error against the exact solution of the same problem, relative");
  command->add_flag("--digital", options->digital, "Arithmetic only: no circuits, no ngspice");
  command->add_flag("--resume", options->resume,
                    "Go on with the study that was interrupted, in the folder --out");
  add_simulator(*command, options->simulator);
}

void add_grasp(Parser& parser) {
  const auto [command, options] = parser.add<GraspOptions>(
      "grasp",
      "Say which joint torques a hand's fingertip forces mean, whether they carry the load, and "
      "which torques would");
  command->add_option("HAND", options->hand, "Hand file (TOML): fingers, contacts, load")
      ->required();
  command->add_flag("--allow-outside", options->allow_outside,
                    "Let the hand name files elsewhere than beside its own and below: only for a "
                    "hand of your own");
  add_results(*command, options->results, "Folder for report.html and result.json",
              "Write the result as JSON");
  add_columns(*command, options->columns);
}

void add_init(Parser& parser) {
  const auto [command, options] = parser.add<InitOptions>(
      "init",
      "Write a scene for recorded readings, with comments; asks on a terminal for what no option "
      "says");
  command->add_option("--from-csv", options->recording, "Recorded readings, CSV or .npy")
      ->required();
  command->add_option("-o,--output", options->output, "Scene file (default: standard output)");
  command->add_flag("--force", options->force, "Replace a scene that is there");
  command
      ->add_option("--quantity", options->quantities,
                   "What every taxel measures: stress_x, stress_y, shear_xy, strain_x, strain_y, "
                   "or several with commas (default: as the columns are named)")
      ->delimiter(',');
  command->add_option("--pitch", options->pitch, "From one taxel to the next");
  command->add_option("--depth", options->depths, "Of the taxels below the surface; 1.0,1.5: two")
      ->delimiter(',');
  command->add_option("--modulus", options->modulus, "Young's modulus of the pad");
  command->add_option("--poisson", options->poisson, "Poisson's ratio (default: 0.45)");
  command->add_option("--layer", options->layer,
                      "Thickness of the pad on a rigid base (default: a half plane)");
  command->add_option("--base", options->base, "What holds a layer: bonded or frictionless")
      ->capture_default_str();
  command
      ->add_option("--noise", options->noise,
                   "Rms of the readings' noise; with commas one for each quantity")
      ->delimiter(',');
  command->add_option("--length-unit", options->length_unit, "Of pitch, depth and layer: mm, ...");
  command->add_option("--modulus-unit", options->modulus_unit, "Of Young's modulus: MPa, ...");
  command->add_option("--unit", options->stress_unit,
                      "Of the readings: kPa, ... (default: as the header says)");
  command->add_option("--force-unit", options->force_unit, "Of loads in the scene: N/mm, ...");
  add_columns(*command, options->columns);
}

void add_check(Parser& parser) {
  const auto [command, options] = parser.add<CheckOptions>(
      "check",
      "Look at recorded readings before they are trusted: units, sign, dead and noisy taxels, "
      "baseline, drift, noise; and say what to write in the scene");
  add_scene(*command, options->scene);
  command
      ->add_option("--readings", options->readings,
                   "Recorded readings, CSV or .npy; - reads standard input")
      ->required();
  add_columns(*command, options->columns);
  command->add_option("--json", options->json, "Write the check as JSON (- = standard output)");
  command->add_flag("--strict", options->strict, "Exit with status 1 if anything is suspicious");
}

/// CLI11 only says that a sub-command is required; says which one was meant.
void check_command(const CLI::App& app, std::span<const std::string> arguments) {
  if (arguments.empty() || arguments.front().starts_with('-')) return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), arguments.front()) != names.end()) return;
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string near(nearest(arguments.front(), known));
  throw WrongUsage("there is no command '" + arguments.front() + "'" +
                   (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

}  // namespace

std::optional<Command> parse(std::span<const std::string> arguments, std::ostream& out) {
  Parser parser;
  parser.app.set_version_flag("--version", "tactile-net " + std::string(version()) +
                                               "\nFFT: " + std::string(name(fft_library())) + "\n" +
                                               report::in_words(confinement()));
  parser.app.require_subcommand(1);
  for (const auto add : {add_run, add_gen, add_relax, add_certify, add_simulate, add_solve,
                         add_identify, add_plan, add_tradeoff, add_grasp, add_init, add_check})
    add(parser);
  check_command(parser.app, arguments);
  try {
    parser.app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw WrongUsage(error.what());
    parser.app.exit(error, out);  // --help, --version
  }
  return parser.command;
}

}  // namespace tactile_net::tool
