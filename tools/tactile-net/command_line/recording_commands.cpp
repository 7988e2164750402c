// What the commands take that begin with recorded readings.
#include <array>
#include <vector>

#include "command_line/all_commands.hpp"
#include "tactile_net/lab/method.hpp"

namespace tactile_net::tool {
namespace {

void add_missing(Arguments& command, lab::Missing& missing) {
  constexpr std::array policies = {lab::Missing::fail, lab::Missing::skip, lab::Missing::estimate};
  command.add_choice("--missing", missing, policies,
                     "Where a reading is missing (empty, NaN, NA): fail; skip the frame, whose "
                     "row is then empty; or estimate it from the other taxels, as if those "
                     "without a reading were dead");
}

}  // namespace

void add_init(AllCommands& all) {
  auto [command, options] = all.add<InitOptions>(
      {.name = "init",
       .text =
           "Write a scene for recorded readings, or for a sensor by its name, with comments; on "
           "a terminal it asks for each value that no option gives",
       .pages = {"check.md", "tutorial.md", "sensors.md"},
       .examples = {
           {"init --from-csv mine.csv -o pad.toml", "asks for pitch, depth and modulus"},
           {"init --from-csv scenes/recorded/thin-pad.csv --quantity stress_x,shear_xy --pitch "
            "0.5e-3 --depth 3e-3 --modulus 0.2e6 --layer 3e-3 -o pad.toml",
            "everything is given, nothing is asked"},
           {"init --sensor paxini --model PXSR-STDDP03A --layer 3 -o finger.toml",
            "a fingertip that is sold, and its taxels beside it"}}});
  command.add_option("--from-csv", options.recording, file("FILE", {"csv", "npy"}),
                     "Recorded readings, CSV or .npy");
  command.add_option("--sensor", options.sensor, text("NAME"),
                     "A sensor by its name instead: paxini, flexitac, xela; of others it says what "
                     "makes a scene. Lengths are in mm then");
  command.add_option("--model", options.model, text("NAME"),
                     "Of the sensor: PXSR-STDDP03A; of a flat one rows and columns, 4x6");
  command.add_option("-o,--output", options.output, main_output({"toml"}),
                     "Scene file (default: standard output)");
  command.add_flag("--force", options.force, "Replace a scene that is there");
  command.add_option("--quantity", options.quantities, text("LIST"),
                     "What every taxel measures: stress_x, stress_y, shear_xy, strain_x, strain_y, "
                     "or several with commas (default: as the columns are named)");
  command.add_option("--pitch", options.pitch, number(), "Distance from one taxel to the next");
  command.add_option("--depth", options.depths, text("LIST"),
                     "Depth of the taxels below the surface; several with commas: 1.0,1.5");
  command.add_option("--modulus", options.modulus, number(), "Young's modulus of the pad");
  command.add_option("--poisson", options.poisson, number(), "Poisson's ratio (default: 0.45)");
  command.add_option("--layer", options.layer, number(),
                     "Thickness of the pad on a rigid base (default: a half plane)");
  constexpr std::array bases = {Base::bonded, Base::frictionless};
  command.add_choice("--base", options.base, bases, "How the base holds a layer");
  command.add_option("--noise", options.noise, text("LIST"),
                     "Noise of the readings, rms; with commas one for each quantity");
  command.add_option("--length-unit", options.length_unit, text("UNIT"),
                     "Unit of pitch, depth and layer: mm, ...");
  command.add_option("--modulus-unit", options.modulus_unit, text("UNIT"),
                     "Unit of Young's modulus: MPa, ...");
  command.add_option("--unit", options.stress_unit, text("UNIT"),
                     "Unit of the readings: kPa, ... (default: as the header says)");
  command.add_option("--force-unit", options.force_unit, text("UNIT"),
                     "Unit of loads in the scene: N/mm, ...");
  add_columns(command, options.columns);
}

void add_check(AllCommands& all) {
  auto [command, options] = all.add<CheckOptions>(
      {.name = "check",
       .text = "Check recorded readings before you trust them: units, sign, dead and noisy taxels, "
               "baseline, drift, noise; and say what to write in the scene",
       .pages = {"check.md"},
       .examples = {{"check scenes/recorded/thin-pad.toml --readings scenes/recorded/thin-pad.csv",
                     "what was understood, and what looks wrong"},
                    {"check pad.toml --readings mine.csv --strict",
                     "for scripts: exit status 1 if anything is suspicious"}}});
  add_scene(command, options.scene);
  command
      .add_option("--readings", options.readings, file("FILE", {"csv", "npy"}),
                  "Recorded readings, CSV or .npy; - reads standard input")
      .required = true;
  add_columns(command, options.columns);
  add_json(command, options.json, "Write the check as JSON");
  command.add_flag("--strict", options.strict, "Exit with status 1 if anything is suspicious");
}

void add_calibrate(AllCommands& all) {
  auto [command, options] = all.add<CalibrateOptions>(
      {.name = "calibrate",
       .text = "Find depth, layer, moduli, gains and offsets from a log of known presses, and say "
               "what the log cannot determine",
       .pages = {"calibration.md"},
       .examples = {
           {"calibrate scenes/calibration/fe-rods.csv --scene scenes/calibration/fe-rods.toml "
            "-o calibrated.toml",
            "a scene that solve, run, identify and plan take"},
           {"calibrate log.csv --scene pad.toml --robust --out out",
            "with a page, out/report.html; readings and forces that stand out have little weight"},
           {"calibrate skin-balls.csv --scene skin-balls.toml "
            "-o skin.toml",
            "for a skin, from presses by balls"}}});
  command
      .add_option("LOG", options.log, file("LOG", {"csv"}),
                  "Log of presses (CSV): a row a press, and 20 rows without load")
      .required = true;
  command
      .add_option("--scene", options.scene, file("SCENE", {"toml"}),
                  "Scene file (TOML) that says what is known of the pad; - reads standard input")
      .required = true;
  command.add_option("-o,--output", options.output, output_file({"toml"}),
                     "Scene file to write: the scene with the values that were found; comments "
                     "stay (- = standard output)");
  command.add_option("--out", options.results.folder, folder(),
                     "Folder for report.html and result.json");
  add_json(command, options.results.json, "Write values, deviations and verdicts as JSON");
  command.add_flag("--robust", options.robust,
                   "Give little weight to readings, forces and positions that stand out, and leave "
                   "out a force that does not fit");
  command.add_option("--next", options.next, number(),
                     "Recommend this many presses to do next, and say what each improves");
  command.add_option("--target", options.target, text("NAME"),
                     "What the presses of --next determine best: depth, ... (default: the readings "
                     "under any load)");
  command.add_option("--fix", options.fixed, text("LIST"),
                     "Keep the scene's values of these: poisson_ratio,thickness, ...");
  command.add_flag("--force", options.results.force,
                   "Write -o although the fit is poor, and let --out replace files that "
                   "tactile-net did not write");
}

void add_solve(AllCommands& all) {
  auto [command, options] = all.add<SolveOptions>(
      {.name = "solve",
       .text = "Turn recorded readings, one frame a row, into tractions, one frame a row",
       .pages = {"results.md", "scene.md"},
       .examples = {{"solve scenes/recorded/thin-pad.toml --readings scenes/recorded/thin-pad.csv "
                     "--out out",
                     "the page of a recording, out/report.html"},
                    {"solve pad.toml --readings mine.csv --columns 2-42 --missing estimate -o "
                     "tractions.csv",
                     "columns by their numbers, and frames in which a reading is missing"},
                    {"solve skin.toml --readings long.npy --plan skin.plan -o tractions.npy "
                     "--contacts contacts.csv",
                     "a long recording, by a plan that the command plan wrote"}}});
  add_scene(command, options.scene, "Scene file (TOML): sensor, material, alpha");
  command
      .add_option("--readings", options.readings, file("FILE", {"csv", "npy"}),
                  "CSV file with a header (columns such as stress_x_0), or .npy of shape (frames, "
                  "readings); - reads standard input and writes each frame as it comes")
      .required = true;
  std::vector<Method> methods;
  for (const lab::MethodTraits& traits : lab::methods())
    if (traits.solves_frames) methods.push_back(traits.method);
  command.add_choice("--method", options.method, methods, "How to solve a frame");
  command.add_option("-o,--output", options.output, main_output({"csv", "npy"}),
                     "CSV or .npy file for the tractions [unit of E] (default: CSV on standard "
                     "output)");
  add_folder(command, options.results.folder, options.results.force,
             "Folder for report.html, the page of the recording; result.json, shown.csv "
             "(the frames in its pictures) and, without -o, tractions.csv");
  command.add_option("--uncertainty", options.uncertainty, output_file({"csv"}),
                     "CSV file for each frame's forces, centre and angle with their standard "
                     "deviations, the deviation of every traction, alpha and the verdict");
  add_columns(command, options.columns);
  add_missing(command, options.missing);
  command.add_option(
      "--share-alpha", options.share_alpha, number(),
      "Choose alpha for this many frames together, each frame and those before it, such as 20: "
      "tractions then change less from frame to frame (default: for each frame alone)");
  command.add_option("--plan", options.plan, file("FILE", {"plan"}),
                     "Plan file of this scene: solve frames as its controller does, thousands a "
                     "second, with one alpha and without bands");
  command.add_option("--contacts", options.contacts, output_file({"csv"}),
                     "CSV file for each frame's forces, centre, margins, doubts and status, as the "
                     "controller with the plan of --plan computes them");
  add_json(command, options.results.json,
           "Write a summary as JSON, with verdict and alpha of the frames that the page shows");
}

void add_report(AllCommands& all) {
  auto [command, options] = all.add<ReportOptions>(
      {.name = "report",
       .text = "Solve many recordings of one sensor, and say in a table which to look at first",
       .pages = {"results.md"},
       .examples = {{"report recordings --scene pad.toml --out out",
                     "every .csv and .npy in a folder; the table in out/report.html, with a page "
                     "for each recording"},
                    {"report monday.csv tuesday.csv --scene pad.toml --csv -",
                     "the table alone, as CSV on standard output"}}});
  command.add_list("RECORDING", options.recordings, file("RECORDING", {"csv", "npy"}),
                   "Recorded readings, CSV or .npy, or folders that hold some");
  command
      .add_option("--scene", options.scene, file("SCENE", {"toml"}),
                  "Scene file (TOML) of the sensor that recorded them all; - reads standard input")
      .required = true;
  add_results(command, options.results,
              "Folder for report.html, the table; result.json and recordings.csv, the same rows; "
              "and recordings/NAME/report.html, the page of each recording",
              "Write the rows as JSON");
  command.add_option("--csv", options.csv, output_file({"csv"}),
                     "Write the rows as CSV (- = standard output)");
  command.add_flag("--no-pages", options.no_pages,
                   "No page for each recording in --out: the table alone");
  command.add_flag("--recursive", options.recursive,
                   "Search the folders inside of folders too, but not --out");
  add_columns(command, options.columns);
  add_missing(command, options.missing);
}

void add_plan(AllCommands& all) {
  auto [command, options] = all.add<PlanOptions>(
      {.name = "plan",
       .text = "Make the plan that a controller loads: the fastest way to solve a frame with a "
               "stated accuracy, and the reason",
       .pages = {"control.md"},
       .examples = {
           {"plan scenes/fingertip.toml -o pad.plan", "the fastest with an error of at most 1e-7"},
           {"plan scenes/recorded/thin-pad.toml --readings scenes/recorded/thin-pad.csv "
            "--deadline 100us -o pad.plan",
            "alpha from recorded frames; it fails if a frame takes longer"},
           {"plan scenes/skins/sphere.toml --friction-limit 0.8 --deadline 1ms -o skin.plan",
            "of a skin, whose frames neither pull nor drag more than friction allows"}}});
  add_scene(command, options.scene, "Scene file (TOML): sensor, material, alpha");
  command.add_option("-o,--output", options.output, output_file({"plan"}),
                     "Plan file, which load_plan reads (default: only print what it would be)");
  command.add_option("--accuracy", options.accuracy, number(),
                     "Largest error, relative to the tractions, of the planned against the dense "
                     "product");
  command.add_option("--deadline", options.deadline, text("TIME"),
                     "Longest time for a frame on this machine: 100us, 1ms, ...");
  command.add_option("--readings", options.readings, file("FILE", {"csv", "npy"}),
                     "Recorded frames (CSV or .npy): the plan has the median of the alphas that "
                     "the scene's rule chooses for them");
  add_columns(command, options.columns);
  command.add_option("--friction", options.friction, number(),
                     "Friction coefficient for the friction margin (default: the scene's "
                     "friction_limit)");
  command.add_option("--friction-limit", options.friction_limit, number(),
                     "Frames obey |q| <= MU p in every cell: a fixed number of steps, and what "
                     "they leave undone is said with each frame");
  command.add_flag("--nonnegative", options.nonnegative,
                   "Frames obey p >= 0 in every cell, in the same way");
  command.add_option("--steps", options.steps, number(),
                     "Steps of a frame towards these constraints, 1 to 64 (default: as few as "
                     "leave a tenth of a standard deviation)");
  command.add_option("--share", options.share, number(),
                     "Share of the deadline that a frame with constraints may take");
  constexpr std::array structures = {Structure::dense, Structure::low_rank, Structure::reflections,
                                     Structure::reflections_low_rank, Structure::fft};
  command.add_choice("--structure", options.structure, structures,
                     "How the product is computed (default: the cheapest way); reflections use the "
                     "array's mirror symmetry, fft is for lines only");
  constexpr std::array precisions = {Precision::float64, Precision::float32};
  command.add_choice("--precision", options.precision, precisions,
                     "Precision of the product's numbers (default: the cheapest)");
  command.add_flag("--allow-fft", options.allow_fft,
                   "Allow fft too, for long arrays: the controller then links "
                   "tactile_net::spectral (GPL if that was built with FFTW)");
  command.add_flag("--no-diagnostics", options.no_diagnostics,
                   "Leave out residual, outliers and dead taxels at run time: faster");
  add_json(command, options.json, "Write the choice as JSON");
}

void add_grasp(AllCommands& all) {
  auto [command, options] = all.add<GraspOptions>(
      {.name = "grasp",
       .text = "Compute the joint torques that a hand's fingertip forces mean, whether these "
               "forces carry the load, and which torques would hold it",
       .pages = {"hand.md", "results.md"},
       .examples = {
           {"grasp scenes/hands/two-fingers.toml --out out", "with a drawing of the hand"},
           {"grasp scenes/hands/box.toml --out out", "fingertips that are skins, in space"},
           {"grasp scenes/recorded/hand.toml --json -", "from recorded readings, as JSON"}}});
  command
      .add_option("HAND", options.hand, file("HAND", {"toml"}),
                  "Hand file (TOML): fingers, contacts, load; - reads it from standard input")
      .required = true;
  command.add_flag(
      "--allow-outside", options.allow_outside,
      "Let the hand name files outside its own folder; use it only for a hand that you wrote");
  add_results(command, options.results, "Folder for report.html and result.json",
              "Write the result as JSON");
  add_columns(command, options.columns);
}

}  // namespace tactile_net::tool
