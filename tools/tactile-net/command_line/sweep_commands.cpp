// What the commands take that put a scene through many values.
#include "command_line/all_commands.hpp"

namespace tactile_net::tool {

void add_sweep(AllCommands& all) {
  auto [command, options] = all.add<SweepOptions>(
      {.name = "sweep",
       .text = "Run a scene at all the values that a study names, on every processor; a sweep that "
               "was stopped continues",
       .pages = {"sweeps.md"},
       .examples = {{"sweep scenes/sweeps/depth.toml -o out",
                     "rows in out/results.csv, errors over the axes in out/report.html"},
                    {"sweep study.toml -o out --shard 3/8",
                     "one eighth of it; run the others on other machines, then merge"},
                    {"sweep study.toml -o out --slurm 8 --time 2:00:00 > job.sh",
                     "a job array for a cluster; start it by sbatch job.sh"}}});
  command.add_option("STUDY", options.study, file("STUDY", {"toml"}), "Study file (TOML)")
      .required = true;
  command
      .add_option("-o,--out", options.folder, folder(),
                  "Folder for the journals, results.csv, result.json, report.html and the plots' "
                  "data (CSV); points that are done there are not done again")
      .required = true;
  command.add_flag("--force", options.force,
                   "Let --out replace files that tactile-net has not written there");
  add_json(command, options.json, "Write the result as JSON, the same as result.json of --out");
  command.add_option("--jobs", options.jobs, number(),
                     "How many points to compute at once (default: one for each processor)");
  command.add_option("--shard", options.shard, text("K/N"),
                     "Compute only the points whose index is K - 1 modulo N");
  command.add_flag(
      "--allow-outside", options.allow_outside,
      "Let the study name a scene outside its own folder; use it only for a study that you wrote");
  command.add_option(
      "--slurm", options.slurm, number(),
      "Print a job file for Slurm with an array of this many tasks, and compute nothing");
  command.add_option(
      "--time", options.time, text("TIME"),
      "Time limit of one task, for --slurm: minutes such as 90, or 1:30:00, or 2-12:00:00");
  add_simulator(command, options.simulator);
}

void add_merge(AllCommands& all) {
  auto [command, options] = all.add<MergeOptions>(
      {.name = "merge",
       .text = "Put the shards of a sweep together: say which points are missing, or write all "
               "rows in order, with a hash that does not depend on which machine computed them",
       .pages = {"sweeps.md"},
       .examples = {{"merge out", "the shards that share a folder"},
                    {"merge here there --out all", "folders of machines that share none"}}});
  command.add_list("FOLDER", options.folders, folder(),
                   "One or several folders that sweep --out wrote");
  command.add_option(
      "-o,--out", options.folder, folder(),
      "Folder for results.csv, result.json, report.html and the plots' data (default: "
      "the first FOLDER)");
  command.add_flag("--force", options.force,
                   "Let --out replace files that tactile-net has not written there");
  add_json(command, options.json, "Write the result as JSON, the same as result.json of --out");
}

}  // namespace tactile_net::tool
