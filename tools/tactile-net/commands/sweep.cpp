#include "commands/sweep.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "commands/results.hpp"
#include "failure.hpp"
#include "tactile_net/frames/folder_lock.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/pages/sweep_page.hpp"
#include "tactile_net/report/folder.hpp"
#include "tactile_net/report/json/sweep_json.hpp"
#include "tactile_net/report/words/sweep_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/sweep/slurm.hpp"
#include "tactile_net/sweep/sweep.hpp"
#include "tactile_net/system/printable.hpp"
#include "terminal/interruption.hpp"
#include "terminal/printable_stream.hpp"

namespace tactile_net::tool {
namespace {

namespace fs = std::filesystem;

class SweepWatcher final : public sweep::Observer {
 public:
  explicit SweepWatcher(const Streams& streams) : line_(streams) {}
  void progress(const sweep::Progress& progress) override { line_.say(report::in_words(progress)); }
  [[nodiscard]] bool stop() const override { return InterruptionAsWish::came(); }
  [[nodiscard]] Progress& line() noexcept { return line_; }

 private:
  const InterruptionAsWish interruption_;
  Progress line_;
};

/// Into a folder that holds journals, or is empty, or has results already.
void write_results(const sweep::Table& table, const std::string& json, const fs::path& folder,
                   frames::Existing existing, const Streams& streams) {
  drawing::Page page =
      pages::sweep_page(table, {.by = streams.command, .files = {"results.csv", "result.json"}});
  page.files.emplace_back("results.csv", table.csv);
  page.files.emplace_back("result.json", json);
  page.files.emplace_back("report.html", page.html);
  std::vector<std::string> names;
  for (const auto& [name, content] : page.files) names.push_back(name);
  for (const auto& [name, content] : page.files) frames::check_replaceable(folder / name, existing);
  for (const auto& [name, content] : page.files) {
    frames::write_file(folder / name, content);
  }
  say_others(streams.err, folder, frames::other_results(folder, {names.begin(), names.end()}));
}

void print(const sweep::Table& table, const fs::path& folder, const Streams& streams) {
  PrintableStream out(streams.out);
  report::print_cells(out, report::method_cells(table));
  for (const std::string& failure : report::failures_in_words(table))
    out << "without an answer, " << failure << '\n';
  out << "SHA-256 of results.csv: " << table.sha256 << '\n';
  say_report(out, folder);
}

/// What both commands end with, once all points are there.
class Ending {
 public:
  /// Before anything is computed. @throw CannotCreate  also where a report is somebody's own
  Ending(fs::path folder, bool force, const std::string& json, const Streams& streams)
      : folder_(std::move(folder)),
        existing_(report::existing_in(folder_, force)),
        tables_(json != "-"),
        file_(output_if(json, streams)),
        streams_(streams) {}

  /// @throw CheckFailed  no point has an answer; that is written too
  void write(const sweep::Table& table, std::optional<std::size_t> resumed = {}) const {
    const std::string json = report::sweep_json(table, resumed);
    Progress progress(streams_);
    progress.say("drawing the report ...");
    write_results(table, json, folder_, existing_, streams_);
    progress.clear();
    if (tables_) print(table, folder_, streams_);
    tool::write(file_.get(), json);
    if (const std::string nothing = report::nothing_found_in_words(table); !nothing.empty())
      throw CheckFailed(nothing);
  }

 private:
  fs::path folder_;
  frames::Existing existing_;
  bool tables_;
  std::unique_ptr<frames::OutputFile> file_;
  Streams streams_;
};

/// What every task of a job file is told of what was typed for the sweep.
std::vector<std::string> options_of_tasks(const SweepOptions& options) {
  const lab::SimulatorChoice& simulator = options.simulator;
  const lab::SimulatorChoice standard;
  std::vector<std::string> words;
  if (options.force) words.emplace_back("--force");
  if (options.allow_outside) words.emplace_back("--allow-outside");
  if (simulator.kind != standard.kind) words.insert(words.end(), {"--simulator", simulator.kind});
  if (const std::string& program = simulator.ngspice.program; program != standard.ngspice.program) {
    const bool is_place = program.find('/') != program.npos;  // a task may begin elsewhere
    words.insert(words.end(), {"--ngspice", is_place ? fs::absolute(program).string() : program});
  }
  if (simulator.time_limit != standard.time_limit)
    words.insert(words.end(), {"--time-limit", shortest(simulator.time_limit)});
  return words;
}

}  // namespace

void run(const SweepOptions& options, const Streams& streams) {
  const sweep::Shard shard = sweep::shard_in(options.shard);
  if (!options.json.empty() && (options.slurm || shard.count > 1))
    throw WrongUsage("--json",
                     "describes the whole sweep, which a shard does not know: give it to merge");
  if (options.jobs && *options.jobs == 0) throw WrongUsage("--jobs", "must be at least 1");
  if (options.slurm && shard.count > 1)
    throw WrongUsage("--shard", "is set for each task by --slurm: leave it out");
  if (!options.slurm && options.time != SweepOptions{}.time)
    throw WrongUsage("--time", "is for a job file: give --slurm");
  const sweep::Study study(read_study(options.study, {options.allow_outside}));
  if (options.slurm) {
    streams.out << sweep::slurm_script({.study = fs::absolute(options.study).string(),
                                        .folder = fs::absolute(options.folder).string(),
                                        .tasks = *options.slurm,
                                        .time = options.time,
                                        .jobs = options.jobs.value_or(1),
                                        .options = options_of_tasks(options)});
    return;
  }
  const fs::path folder = options.folder;
  const Ending ending(folder, options.force, options.json, streams);
  SweepWatcher watcher(streams);
  const sweep::Progress progress = sweep::sweep(
      study, folder,
      {.jobs = options.jobs.value_or(0), .shard = shard, .simulator = options.simulator}, watcher);
  watcher.line().clear();
  if (progress.deaths > 0)
    streams.err << "note: " << counted(progress.deaths, "worker")
                << " ended unexpectedly; the points begun are computed again, one at a time\n";
  if (!progress.complete())
    throw CheckFailed("stopped at " + report::in_words(progress) +
                      "; the same command continues from here");
  if (shard.count > 1) {
    streams.out << "shard " << options.shard << ": " << counted(progress.points, "point")
                << (progress.points == 1 ? " is" : " are")
                << " done; when all shards are: tactile-net merge "
                << printable(shell_word(folder.string())) << '\n';
    if (const std::string nothing =
            report::nothing_found_in_words(sweep::shard_table(study, folder, shard));
        !nothing.empty())
      throw CheckFailed(nothing);
    return;
  }
  const std::vector<fs::path> folders = {folder};
  const sweep::Table table = sweep::merge(folders);
  const frames::FolderLock lock(folder);
  ending.write(table, progress.earlier);
}

void run(const MergeOptions& options, const Streams& streams) {
  const std::vector<fs::path> folders(options.folders.begin(), options.folders.end());
  const fs::path folder = options.folder.empty() ? folders.front() : fs::path(options.folder);
  const Ending ending(folder, options.force, options.json, streams);
  const sweep::Table table = sweep::merge(folders);
  const frames::FolderLock lock(folder);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error))
    throw frames::CannotCreate(folder.string() +
                               ": error: cannot be created as a folder: " + error.message());
  ending.write(table);
}

}  // namespace tactile_net::tool
