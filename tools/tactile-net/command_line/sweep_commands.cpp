// What the commands take that put a scene through many values.
#include "command_line/all_commands.hpp"

namespace tactile_net::tool {

void add_sweep(AllCommands& all) {
  auto [command, options] = all.add<SweepOptions>(
      {.name = "sweep",
       .text = "Run a scene at all the values that a study names, on every processor, and go on "
               "where an earlier sweep was stopped",
       .pages = {"sweeps.md"},
       .examples = {{"sweep scenes/sweeps/depth.toml -o out",
                     "rows in out/results.csv, errors over the axes in out/report.html"},
                    {"sweep study.toml -o out --shard 3/8",
                     "an eighth of it: on another machine, the others; then merge"},
                    {"sweep study.toml -o out --slurm 8 --time 2:00:00 > job.sh",
                     "a job array for a cluster: sbatch job.sh"}}});
  command.add_option("STUDY", options.study, file("STUDY", {"toml"}), "Study file (TOML)")
      .required = true;
  command
      .add_option("-o,--out", options.folder, folder(),
                  "Folder for the journals, results.csv, result.json, report.html and the plots' "
                  "data (CSV); "
                  "what is done there is not done again")
      .required = true;
  command.add_flag("--force", options.force,
                   "Let --out replace files that tactile-net has not written there");
  add_json(command, options.json, "Write what was found as JSON, as result.json of --out is");
  command.add_option("--jobs", options.jobs, number(),
                     "How many points at once (default: one for each processor)");
  command.add_option("--shard", options.shard, text("K/N"),
                     "Only the points whose index is K - 1 modulo N");
  command.add_flag("--allow-outside", options.allow_outside,
                   "Let the study name a scene outside its own folder");
  command.add_option("--slurm", options.slurm, number(),
                     "Print a job file for Slurm, an array of so many tasks, and compute nothing");
  command.add_option("--time", options.time, text("TIME"),
                     "Of one task, for --slurm: minutes as 90, or 1:30:00, or 2-12:00:00");
  add_simulator(command, options.simulator);
}

void add_merge(AllCommands& all) {
  auto [command, options] = all.add<MergeOptions>(
      {.name = "merge",
       .text = "Put the shards of a sweep together: says what is missing, else writes the rows in "
               "their one order, with a hash that is the same whoever computed them",
       .pages = {"sweeps.md"},
       .examples = {{"merge out", "the shards that share a folder"},
                    {"merge here there --out all", "folders of machines that share none"}}});
  command.add_list("FOLDER", options.folders, folder(),
                   "Folders that sweep --out named, one or several");
  command.add_option(
      "-o,--out", options.folder, folder(),
      "Folder for results.csv, result.json, report.html and the plots' data (default: "
      "the first FOLDER)");
  command.add_flag("--force", options.force,
                   "Let --out replace files that tactile-net has not written there");
  add_json(command, options.json, "Write what was found as JSON, as result.json of --out is");
}

}  // namespace tactile_net::tool
