#include "commands/sweep.hpp"

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "commands/results.hpp"
#include "failure.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/pages/sweep_page.hpp"
#include "tactile_net/report/json/sweep_json.hpp"
#include "tactile_net/report/words/sweep_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/sweep/sweep.hpp"
#include "terminal/interruption.hpp"

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

void print(const sweep::Table& table, std::ostream& out) {
  report::print_cells(out, report::method_cells(table));
  for (const std::string& failure : report::failures_in_words(table))
    out << "without an answer, " << failure << '\n';
  out << "SHA-256 of all rows: " << table.sha256 << '\n';
}

/// Writes what was asked for. @throw CheckFailed  no point has an answer; that is written too
void write(Results& results, const sweep::Table& table, std::optional<std::size_t> resumed,
           const Streams& streams) {
  Progress progress(streams);
  results.write({.print = [&](std::ostream& out) { print(table, out); },
                 .json = [&] { return report::sweep_json(table, resumed); },
                 .page =
                     [&] {
                       drawing::Page page = pages::sweep_page(
                           table, {.by = streams.command, .files = {"results.csv", "result.json"}});
                       page.files.emplace_back("results.csv", table.csv);
                       return page;
                     }},
                progress);
  if (const std::string nothing = report::nothing_found_in_words(table); !nothing.empty())
    throw CheckFailed(nothing);
}

}  // namespace

void run(const SweepOptions& options, const Streams& streams) {
  const sweep::PointRange points =
      options.points.empty() ? sweep::PointRange() : sweep::point_range_in(options.points);
  if (!options.json.empty() && !options.points.empty())
    throw WrongUsage("--json",
                     "describes the whole sweep, which a part does not know: give it to merge");
  if (options.jobs && *options.jobs == 0) throw WrongUsage("--jobs", "must be at least 1");
  if (options.file == "-")
    throw WrongUsage("--output", "must be a file, which a sweep that was stopped goes on with");
  const sweep::Study study(read_study(options.study, {options.allow_outside}));
  Results results({.json = options.json}, streams);
  SweepWatcher watcher(streams);
  lab::SimulatorChoice simulator = options.simulator;
  simulator.ngspice.cancelled = InterruptionAsWish::came;
  const sweep::Progress progress = sweep::sweep(
      study, options.file,
      {.jobs = options.jobs.value_or(0), .points = points, .simulator = simulator}, watcher);
  watcher.line().clear();
  if (!progress.complete())
    throw CheckFailed("stopped at " + report::in_words(progress) +
                      "; the same command continues from here");
  const std::vector<fs::path> files = {options.file};
  const sweep::Table table = sweep::merge(files, points);
  if (options.points.empty()) return write(results, table, progress.earlier, streams);
  streams.out << counted(progress.points, "point") << (progress.points == 1 ? " is" : " are")
              << " done; when all " << study.points()
              << " of the study are: tactile-net merge FILE... --out FOLDER\n";
  if (const std::string nothing = report::nothing_found_in_words(table); !nothing.empty())
    throw CheckFailed(nothing);
}

void run(const MergeOptions& options, const Streams& streams) {
  const std::vector<fs::path> files(options.files.begin(), options.files.end());
  Results results({options.folder, options.force, options.json}, streams);
  write(results, sweep::merge(files), {}, streams);
}

}  // namespace tactile_net::tool
