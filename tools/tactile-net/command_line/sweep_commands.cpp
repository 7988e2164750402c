// What the commands take that put a scene through many values.
#include "command_line/all_commands.hpp"

namespace tactile_net::tool {

void add_sweep(AllCommands& all) {
  auto [command, options] = all.add<SweepOptions>(
      {.name = "sweep",
       .text = "Run a scene at all the values that a study names, on every processor, into a file "
               "of rows; a sweep that was stopped continues",
       .pages = {"sweeps.md"},
       .examples = {{"sweep scenes/sweeps/depth.toml -o rows.csv",
                     "rows in rows.csv; merge rows.csv --out FOLDER draws errors over the axes"},
                    {"sweep study.toml -o part.csv --points 0:100",
                     "the first hundred points; run the others elsewhere, then merge the files"}}});
  command.add_option("STUDY", options.study, file("STUDY", {"toml"}), "Study file (TOML)")
      .required = true;
  command
      .add_option("-o,--output", options.file, output_file({"csv"}),
                  "File of rows (CSV) to append to; points that are done there are not done again")
      .required = true;
  add_json(command, options.json, "Write the result of the whole study as JSON");
  command.add_option("--jobs", options.jobs, number(),
                     "How many points to compute at once (default: one for each processor)");
  command.add_option("--points", options.points, text("A:B"),
                     "Compute only the points from A up to, but not including, B, counted from 0");
  command.add_flag(
      "--allow-outside", options.allow_outside,
      "Let the study name a scene outside its own folder; use it only for a study that you wrote");
  add_simulator(command, options.simulator);
}

void add_merge(AllCommands& all) {
  auto [command, options] = all.add<MergeOptions>(
      {.name = "merge",
       .text = "Put the files of a sweep together: say which points are missing, or write all "
               "rows in order, with a hash that does not depend on which machine computed them",
       .pages = {"sweeps.md"},
       .examples = {{"merge rows.csv", "what the rows of one file come to"},
                    {"merge here.csv there.csv --out all",
                     "rows in all/results.csv, errors over the axes in all/report.html"}}});
  command.add_list("FILE", options.files, file("FILE", {"csv"}),
                   "One or several files that sweep wrote");
  command.add_option("-o,--out", options.folder, folder(),
                     "Folder for results.csv, result.json, report.html and the plots' data (CSV)");
  command.add_flag("--force", options.force,
                   "Let --out replace files that tactile-net has not written there");
  add_json(command, options.json, "Write the result as JSON, the same as result.json of --out");
}

}  // namespace tactile_net::tool
