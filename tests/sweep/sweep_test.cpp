// Sweeps that are stopped, killed or cut into parts: the table is the same.
#include "tactile_net/sweep/sweep.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tactile_net/lab/simulator_choice.hpp"
#include "tests/catch.hpp"
#include "tests/sweep/small_study.hpp"

using namespace tactile_net;
using test::grid_study;
using test::StudyFolder;
namespace fs = std::filesystem;

namespace {

std::size_t line_count(const fs::path& file) {
  const std::string text = test::content(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Does something between two reports, as often as it is asked.
struct Watcher : sweep::Observer {
  std::function<bool()> each = [] { return false; };
  mutable std::size_t asked = 0;
  sweep::Progress last{};

  [[nodiscard]] bool stop() const override {
    ++asked;
    return each();
  }
  void progress(const sweep::Progress& progress) override { last = progress; }
};

sweep::Progress swept(const sweep::Study& study, const fs::path& file,
                      const sweep::Options& options = {.jobs = 2}) {
  sweep::Observer observer;
  return sweep::sweep(study, file, options, observer);
}

sweep::Table merged(const fs::path& file) { return sweep::merge(std::vector<fs::path>{file}); }

/// One point after the other, without a file.
std::string by_hand(const sweep::Study& study) {
  const auto simulator = lab::make_simulator();
  std::string csv;
  for (std::size_t i = 0; i < study.points(); ++i)
    for (const sweep::Row& row : sweep::solve(study, i, *simulator))
      csv += sweep::csv(row, study.keep()) + '\n';
  return csv;
}

std::string without_header(const sweep::Table& table) {
  return table.csv.substr(table.csv.find('\n') + 1);
}

}  // namespace

TEST_CASE("threads find what one finds, in the study's order", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  Watcher watcher;
  const sweep::Progress progress = sweep::sweep(study, folder / "rows.csv", {.jobs = 3}, watcher);
  CHECK(progress.complete());
  CHECK(progress.points == 24);
  CHECK(watcher.last.done == 24);
  const sweep::Table table = merged(folder / "rows.csv");
  CHECK(without_header(table) == by_hand(study));
  CHECK(table.rows.size() == 48);
  CHECK(table.axes == std::vector<std::string>{"sensor.depth", "contact.0.half_width", "repeat"});
  CHECK(swept(study, folder / "alone.csv", {.jobs = 1}).complete());
  CHECK(test::content(folder / "alone.csv") == test::content(folder / "rows.csv"));
}

TEST_CASE("a sweep that is cut into parts has the same hash", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  CHECK(swept(study, folder / "whole.csv").complete());
  const std::string hash = merged(folder / "whole.csv").sha256;
  for (const std::size_t count : {2U, 7U}) {
    std::vector<fs::path> files;
    for (std::size_t first = 0; first < 24; first += 24 / count) {
      if (first > 0) CHECK_THROWS_AS(sweep::merge(files), sweep::MissingPoints);
      files.push_back(folder / ("part-" + std::to_string(count) + std::to_string(first)));
      const sweep::Progress part =
          swept(study, files.back(), {.jobs = 2, .points = {first, first + 24 / count}});
      CHECK(part.points == std::min<std::size_t>(24 / count, 24 - first));
    }
    std::reverse(files.begin(), files.end());
    CHECK(sweep::merge(files).sha256 == hash);
  }
  CHECK_THROWS_WITH(swept(study, folder / "none.csv", {.points = {24, 30}}),
                    ContainsSubstring("has 24 points, and none from 24 on"));
  CHECK_FALSE(fs::exists(folder / "none.csv"));
}

TEST_CASE("what is done is not done again, nor what another range did", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  const fs::path file = folder / "rows.csv";
  CHECK(swept(study, file, {.jobs = 1, .points = {8, 16}}).done == 8);
  CHECK(line_count(file) == 2 + 2 * 8);
  CHECK(sweep::merge(std::vector<fs::path>{file}, {8, 16}).points == 8);
  const sweep::Progress rest = swept(study, file);
  CHECK(rest.earlier == 8);
  CHECK(rest.complete());
  CHECK(line_count(file) == 2 + 2 * 24);
  CHECK(swept(study, file).earlier == 24);
  CHECK(line_count(file) == 2 + 2 * 24);
  CHECK(without_header(merged(file)) == by_hand(study));
}

TEST_CASE("a sweep that is killed goes on, wherever that was", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  const fs::path file = folder / "rows.csv";
  for (const std::size_t kill_at : {1U, 9U, 22U}) {
    const pid_t process = ::fork();
    REQUIRE(process >= 0);
    if (process == 0) {
      Watcher slow;
      slow.each = [] {
        ::usleep(20'000);
        return false;
      };
      try {
        (void)sweep::sweep(study, file, {.jobs = 2}, slow);
      } catch (...) {
      }
      ::_exit(0);
    }
    for (int i = 0; i < 10'000 && (!fs::exists(file) || line_count(file) < kill_at); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    CHECK(line_count(file) >= kill_at);
  }
  const sweep::Progress progress = swept(study, file);
  CHECK(progress.earlier >= 8);
  CHECK(progress.complete());
  CHECK(without_header(merged(file)) == by_hand(study));
}

TEST_CASE("a sweep that is stopped is gone on with", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  Watcher watcher;
  watcher.each = [&] { return watcher.asked > 8; };
  const sweep::Progress progress = sweep::sweep(study, folder / "rows.csv", {.jobs = 1}, watcher);
  CHECK_FALSE(progress.complete());
  CHECK(line_count(folder / "rows.csv") == 2 + 2 * progress.done);
  watcher.each = []() -> bool { throw std::runtime_error("a handler's"); };
  CHECK_THROWS_WITH(sweep::sweep(study, folder / "rows.csv", {.jobs = 2}, watcher), "a handler's");
  CHECK(swept(study, folder / "rows.csv").complete());
  CHECK(without_header(merged(folder / "rows.csv")) == by_hand(study));
}

TEST_CASE("a wish to stop is heard while a point takes long", "[sweep]") {
  const StudyFolder folder;
  const fs::path endless = folder.write("endless", "#!/bin/sh\nexec sleep 60\n");
  fs::permissions(endless, fs::perms::owner_all);
  const sweep::Study study = folder.study(
      "scene = \"pad.toml\"\n"
      "[[axis]]\nkey = \"reconstruct.methods\"\nvalues = [[\"tikhonov\"], [\"network\"]]\n");
  static volatile std::sig_atomic_t wished = 0;
  sweep::Options options{.jobs = 1};
  options.simulator.ngspice.program = endless.string();
  options.simulator.ngspice.cancelled = [] { return wished != 0; };
  Watcher watcher;
  watcher.each = [&] {
    if (watcher.asked > 3) wished = 1;
    return wished != 0;
  };
  const sweep::Progress progress = sweep::sweep(study, folder / "rows.csv", options, watcher);
  wished = 0;
  CHECK(progress.done == 1);  // of the one that was ended there is no row
  CHECK(line_count(folder / "rows.csv") == 3);
}

TEST_CASE("a simulator that fails is the same row every time, and leaves nothing", "[sweep]") {
  const StudyFolder folder;
  fs::create_directory(folder / "tmp");
  ::setenv("TMPDIR", (folder / "tmp").c_str(), 1);
  const sweep::Study study = folder.study(
      "scene = \"pad.toml\"\n"
      "[[axis]]\nkey = \"reconstruct.methods\"\nvalues = [[\"network\"]]\n");
  lab::SimulatorChoice choice;
  choice.ngspice.program = "true";
  const auto simulator = lab::make_simulator(choice);
  const std::string row = sweep::csv(sweep::solve(study, 0, *simulator).at(0), study.keep());
  CHECK(row == sweep::csv(sweep::solve(study, 0, *simulator).at(0), study.keep()));
  CHECK(fs::is_empty(folder / "tmp"));
  ::unsetenv("TMPDIR");
  CHECK_THAT(row, ContainsSubstring("network,0.001,failed,,,,,,,"));
  CHECK_THAT(row, ContainsSubstring("without a usable answer"));
}

TEST_CASE("scenes that fail are rows, not an end", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(
      "scene = \"pad.toml\"\n"
      "[[axis]]\nkey = \"sensor.depth\"\nvalues = [-1, 1.5, nan]\n"
      "[[axis]]\nkey = \"sensor.count\"\nvalues = [9, 1]\n");
  CHECK(swept(study, folder / "rows.csv").complete());
  const sweep::Table table = merged(folder / "rows.csv");
  std::size_t failed = 0;
  for (const sweep::Row& row : table.rows)
    if (row.verdict == "failed") {
      ++failed;
      CHECK_FALSE(row.failure.empty());
      CHECK_FALSE(row.error);
    }
  CHECK(table.rows.front().failure == "sensor.depth must be > 0");
  CHECK(failed >= 4);
  CHECK(failed < table.rows.size());
  CHECK(without_header(table) == by_hand(study));
}

TEST_CASE("a study that was changed does not touch the rows that are there", "[sweep]") {
  const StudyFolder folder;
  CHECK(swept(folder.study(grid_study), folder / "rows.csv").complete());
  const std::string before = test::content(folder / "rows.csv");
  const sweep::Study other =
      folder.study(grid_study + "[[axis]]\nkey = \"contact.0.force\"\nvalues = [2]\n");
  CHECK_THROWS_WITH(swept(other, folder / "rows.csv"), ContainsSubstring("another study"));
  CHECK(test::content(folder / "rows.csv") == before);
  // What it is called is not what it computes.
  CHECK(swept(folder.study("title = \"other\"\n" + grid_study), folder / "rows.csv").earlier == 24);
}

TEST_CASE("a range of points is two numbers, the second left out", "[sweep]") {
  CHECK(sweep::point_range_in("3:8").first == 3);
  CHECK(sweep::point_range_in("3:8").end == 8);
  CHECK(sweep::point_range_in("3:8").has(7));
  CHECK_FALSE(sweep::point_range_in("3:8").has(8));
  for (const char* wrong : {"4:4", "5:4", "4", ":4", "1:", "-1:4", "1:4:2", "a:b", "", "1.5:4",
                            "1:99999999999999999999999"})
    CHECK_THROWS_AS(sweep::point_range_in(wrong), std::invalid_argument);
}
