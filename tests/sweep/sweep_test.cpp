// Workers that are killed, drivers that are killed, shards: the table is the same.
#include "tactile_net/sweep/sweep.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tactile_net/frames/cannot_create.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/sweep/merge.hpp"
#include "tests/catch.hpp"
#include "tests/sweep/small_study.hpp"

using namespace tactile_net;
using test::grid_study;
using test::StudyFolder;
namespace fs = std::filesystem;

namespace {

/// Of this process, or of another.
std::vector<pid_t> children(pid_t parent = ::getpid()) {
  const std::string number = std::to_string(parent);
  std::ifstream file("/proc/" + number + "/task/" + number + "/children");
  std::vector<pid_t> all;
  for (pid_t child = 0; file >> child;) all.push_back(child);
  return all;
}

bool is_running(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string state;
  file >> state >> state >> state;
  return file && state != "Z" && state != "X";
}

bool comes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 10'000 && !condition(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return condition();
}

std::size_t journal_lines(const fs::path& folder) {
  std::size_t lines = 0;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
    if (entry.path().extension() == ".journal") {
      const std::string text = test::content(entry.path());
      lines += static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }
  return lines;
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

sweep::Progress swept(const sweep::Study& study, const fs::path& folder,
                      const sweep::Options& options = {.jobs = 2}) {
  sweep::Observer observer;
  return sweep::sweep(study, folder, options, observer);
}

sweep::Table merged(const fs::path& folder) { return sweep::merge(std::vector<fs::path>{folder}); }

/// One point after the other in this process, without journals.
std::string by_hand(const sweep::Study& study) {
  const auto simulator = lab::make_simulator();
  std::vector<std::string> axes;
  for (const sweep::Axis& axis : study.axes()) axes.push_back(axis.key);
  std::string csv = sweep::header(axes, study.keep()) + '\n';
  for (std::size_t i = 0; i < study.points(); ++i)
    for (const sweep::Row& row : sweep::solve(study, i, *simulator))
      csv += sweep::csv(row, study.keep()) + '\n';
  return csv;
}

}  // namespace

TEST_CASE("workers find what one process finds", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  Watcher watcher;
  const sweep::Progress progress = sweep::sweep(study, folder / "out", {.jobs = 3}, watcher);
  CHECK(progress.complete());
  CHECK(progress.points == 24);
  CHECK(progress.deaths == 0);
  CHECK(watcher.last.done == 24);
  const sweep::Table table = merged(folder / "out");
  CHECK(table.csv == by_hand(study));
  CHECK(table.rows.size() == 48);
  CHECK(table.axes == std::vector<std::string>{"sensor.depth", "contact.0.half_width", "repeat"});
  CHECK(children().empty());
}

TEST_CASE("one shard, two and seven have equal hashes", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  std::vector<std::string> hashes;
  for (const std::size_t count : {1U, 2U, 7U}) {
    const fs::path out = folder / ("out-" + std::to_string(count));
    for (std::size_t number = count; number >= 1; --number) {
      if (number < count) CHECK_THROWS_AS(merged(out), sweep::MissingPoints);
      CHECK(swept(study, out, {.jobs = 1, .shard = {number, count}}).complete());
    }
    hashes.push_back(merged(out).sha256);
  }
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == hashes[2]);
}

TEST_CASE("what is done is not done again, in other shards either", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  CHECK(swept(study, folder / "out", {.jobs = 1, .shard = {2, 3}}).done == 8);
  const std::size_t lines = journal_lines(folder / "out");
  const sweep::Progress rest = swept(study, folder / "out");
  CHECK(rest.earlier == 8);
  CHECK(rest.complete());
  CHECK(swept(study, folder / "out").earlier == 24);
  // Two heads of two workers more at most, and two rows for each point once.
  CHECK(journal_lines(folder / "out") <= lines + 2 * 2 + 2 * 16);
}

TEST_CASE("workers that are killed cost nothing but time", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  Watcher watcher;
  std::size_t killed = 0;
  watcher.each = [&] {
    if (watcher.asked % 4 == 3 && killed < 2) {  // a point that three die of is given up
      const std::vector<pid_t> workers = children();
      REQUIRE_FALSE(workers.empty());
      ::kill(workers[killed++ % workers.size()], SIGKILL);
    }
    return false;
  };
  const sweep::Progress progress = sweep::sweep(study, folder / "out", {.jobs = 2}, watcher);
  CHECK(progress.complete());
  CHECK(killed == 2);
  CHECK(progress.deaths >= 1);  // the last may come when all is done
  CHECK(merged(folder / "out").csv == by_hand(study));
}

TEST_CASE("a driver that is killed leaves no worker, and its sweep goes on", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  const fs::path out = folder / "out";
  const pid_t driver = ::fork();
  REQUIRE(driver >= 0);
  if (driver == 0) {
    Watcher slow;
    slow.each = [] {
      ::usleep(20'000);
      return false;
    };
    try {
      (void)sweep::sweep(study, out, {.jobs = 2}, slow);
    } catch (...) {
    }
    ::_exit(0);
  }
  REQUIRE(comes_true([&] { return journal_lines(out) >= 8; }));
  const std::vector<pid_t> workers = children(driver);
  CHECK(workers.size() == 2);
  ::kill(driver, SIGKILL);
  ::waitpid(driver, nullptr, 0);
  for (const pid_t worker : workers) CHECK(comes_true([&] { return !is_running(worker); }));
  // And a line that it was about to write.
  for (const auto& entry : fs::recursive_directory_iterator(out))
    if (entry.path().extension() == ".journal")
      std::ofstream(entry.path(), std::ios::app) << "1/2,3,1.0,0";

  const sweep::Progress progress = swept(study, out);
  CHECK(progress.earlier >= 2);
  CHECK(progress.complete());
  CHECK(merged(out).csv == by_hand(study));
}

TEST_CASE("a sweep that is stopped is gone on with", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  Watcher watcher;
  watcher.each = [&] { return watcher.asked > 8; };
  const sweep::Progress progress = sweep::sweep(study, folder / "out", {.jobs = 1}, watcher);
  CHECK_FALSE(progress.complete());
  CHECK(children().empty());
  CHECK(swept(study, folder / "out").complete());
  CHECK(merged(folder / "out").csv == by_hand(study));
}

TEST_CASE("a point that its workers die of is a row that says so, and the others have answers",
          "[sweep]") {
  const StudyFolder folder;
  const fs::path endless = folder.write("endless", "#!/bin/sh\nexec sleep 60\n");
  fs::permissions(endless, fs::perms::owner_all);
  const sweep::Study study = folder.study(
      "scene = \"pad.toml\"\n"
      "[[axis]]\nkey = \"sensor.depth\"\nvalues = [1, 2]\n"
      "[[axis]]\nkey = \"reconstruct.methods\"\n"
      "values = [[\"tikhonov\"], [\"network\"], [\"dft\"]]\n");
  sweep::Options options{.jobs = 2};
  options.simulator.ngspice.program = endless.string();
  Watcher killer;  // of every worker that is at a network
  killer.each = [] {
    for (const pid_t worker : children())
      if (!children(worker).empty()) ::kill(worker, SIGKILL);
    return false;
  };
  const sweep::Progress progress = sweep::sweep(study, folder / "out", options, killer);
  CHECK(progress.complete());
  CHECK(progress.deaths == 2 * sweep::most_deaths);
  const sweep::Table table = merged(folder / "out");
  REQUIRE(table.rows.size() == 6);
  for (const sweep::Row& row : table.rows) {
    CAPTURE(sweep::csv(row, table.keep));
    CHECK(row.failure == (row.index % 3 == 1 ? "its worker died, 3 times" : ""));
  }
  CHECK(swept(study, folder / "out", options).earlier == 6);
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
  CHECK(swept(study, folder / "out").complete());
  const sweep::Table table = merged(folder / "out");
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
  CHECK(table.csv == by_hand(study));
}

TEST_CASE("a second driver in a shard's folder is told who is there", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  std::string told;
  Watcher watcher;
  watcher.each = [&] {
    try {
      (void)swept(study, folder / "out");
    } catch (const frames::CannotCreate& error) {
      told = error.what();
    }
    return true;
  };
  (void)sweep::sweep(study, folder / "out", {.jobs = 1}, watcher);
  CHECK_THAT(told, ContainsSubstring("process " + std::to_string(::getpid())));
}

TEST_CASE("another study's folder is refused, before anything is written", "[sweep]") {
  const StudyFolder folder;
  CHECK(swept(folder.study(grid_study), folder / "out").complete());
  const std::size_t lines = journal_lines(folder / "out");
  const sweep::Study other = folder.study("title = \"other\"\n" + grid_study +
                                          "[[axis]]\nkey = \"contact.0.force\"\nvalues = [2]\n");
  CHECK_THROWS_WITH(swept(other, folder / "out"), ContainsSubstring("another study"));
  CHECK(journal_lines(folder / "out") == lines);
}

TEST_CASE("a folder that cannot be made or written to is known at once", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  CHECK_THROWS_AS(swept(study, folder / "pad.toml"), frames::CannotCreate);
  CHECK_THROWS_AS(swept(study, folder / "pad.toml/out"), frames::CannotCreate);
  CHECK_THROWS_AS(swept(study, "/proc/none"), frames::CannotCreate);
  if (::geteuid() != 0) {
    fs::create_directory(folder / "shut");
    fs::permissions(folder / "shut", fs::perms::owner_read | fs::perms::owner_exec);
    CHECK_THROWS_AS(swept(study, folder / "shut"), frames::CannotCreate);
  }
}

TEST_CASE("a full disk ends the sweep, which goes on when there is room", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 1000;  // a head and a few rows
  ::setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    (void)swept(study, folder / "out", {.jobs = 1});
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  CHECK_THAT(message, ContainsSubstring("worker-1.journal could not be written"));
  CHECK(children().empty());
  const sweep::Progress progress = swept(study, folder / "out");
  CHECK(progress.complete());
  CHECK(merged(folder / "out").csv == by_hand(study));
}

TEST_CASE("shards are counted from 1", "[sweep]") {
  CHECK(sweep::shard_in("3/8").number == 3);
  CHECK(sweep::shard_in("8/8").count == 8);
  for (const char* wrong : {"0/4", "5/4", "4", "/4", "1/", "1/0", "-1/4", "1/4/2", "a/b", "",
                            "1.5/4", "1/99999999999999999999999"})
    CHECK_THROWS_AS(sweep::shard_in(wrong), std::invalid_argument);
}
