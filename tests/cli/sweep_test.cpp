// sweep and merge: shards, kills, and what is refused.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tactile_net/numeric/sha256.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

const std::string pad =
    "[sensor]\ncount = 41\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2.0\nforce = 1.0\n"
    "[noise]\nrms = 0.01\n"
    "[reconstruct]\nmethods = [\"tikhonov\", \"closed_form\"]\nalpha = 1e-3\n";

/// 20 points.
const std::string study =
    "title = \"Depths\"\nscene = \"pad.toml\"\nrepeats = 4\n"
    "[[axis]]\nkey = \"sensor.depth\"\nfrom = 0.5\nto = 2.5\ncount = 5\n";

struct Sweep {
  Folder folder;
  std::string file = folder.write("study.toml", study);
  std::string out = folder / "out";

  Sweep() { (void)folder.write("pad.toml", pad); }
  [[nodiscard]] std::vector<std::string> command(const std::string& into = "out") const {
    return {"sweep", file, "-o", folder / into, "--jobs", "2"};
  }
  [[nodiscard]] ProcessResult run(std::vector<std::string> more = {},
                                  const std::string& into = "out") const {
    std::vector<std::string> arguments = command(into);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tool(arguments);
  }
  [[nodiscard]] std::string csv(const std::string& from = "out") const {
    return read_text(fs::path(folder / from) / "results.csv");
  }
};

std::size_t journal_lines(const fs::path& folder) {
  std::size_t lines = 0;
  std::error_code ignored;
  for (fs::recursive_directory_iterator entry(folder, ignored), end; entry != end;
       entry.increment(ignored))
    if (entry->path().extension() == ".journal") {
      const std::string text = read_text(entry->path());
      lines += static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }
  return lines;
}

}  // namespace

TEST_CASE("sweep writes rows, their hash and a page", "[cli][sweep]") {
  const Sweep sweep;
  const ProcessResult result = sweep.run();
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  const std::string csv = sweep.csv();
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 41);
  CHECK(csv.starts_with("index,sensor.depth,repeat,seed,method,alpha,verdict,error,"));
  CHECK_THAT(result.output, ContainsSubstring("SHA-256 of results.csv: " + sha256_text(csv)));
  CHECK_THAT(result.output, ContainsSubstring("closed_form  20"));
  const std::string page = read_text(sweep.out + "/report.html");
  CHECK_THAT(page, ContainsSubstring("Depths") && ContainsSubstring("sensor.depth") &&
                       ContainsSubstring(sha256_text(csv)) &&
                       ContainsSubstring("href=\"results.csv\""));
  CHECK(fs::exists(sweep.out + "/error-1.csv"));
  CHECK_FALSE(fs::exists(sweep.out + "/alpha-1.csv"));  // the scene gives it

  const ProcessResult again = sweep.run();
  CHECK(again.code == 0);
  CHECK(again.output == result.output);
}

TEST_CASE("shards are merged when all are there, from one folder or from several", "[cli][sweep]") {
  const Sweep sweep;
  REQUIRE(sweep.run().code == 0);
  const ProcessResult first = sweep.run({"--shard", "1/3"}, "shared");
  CHECK(first.code == 0);
  CHECK_THAT(first.output, ContainsSubstring("shard 1/3: 7 points are done"));
  CHECK(sweep.run({"--shard", "2/3"}, "shared").code == 0);
  CHECK(sweep.run({"--shard", "3/3"}, "alone").code == 0);
  const ProcessResult part = tool({"merge", sweep.folder / "shared"});
  CHECK(part.code == 1);
  CHECK_THAT(part.errors, ContainsSubstring("6 of 20 points are missing, 2 first"));
  CHECK_FALSE(fs::exists(sweep.folder / "shared/results.csv"));
  const ProcessResult all = tool(
      {"merge", sweep.folder / "shared", sweep.folder / "alone", "--out", sweep.folder / "merged"});
  CAPTURE(all.errors);
  CHECK(all.code == 0);
  CHECK(sweep.csv("merged") == sweep.csv());
}

TEST_CASE("a sweep whose driver is killed outright goes on, and ends the same", "[cli][sweep]") {
  const Sweep sweep;
  REQUIRE(sweep.run({}, "whole").code == 0);
  std::vector<std::string> arguments = sweep.command();
  arguments.insert(arguments.begin(), TOOL);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t driver = ::fork();
  REQUIRE(driver >= 0);
  if (driver == 0) {
    ::execv(TOOL, argv.data());
    ::_exit(127);
  }
  for (int i = 0; i < 10'000 && journal_lines(sweep.out) < 6; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(driver, SIGKILL);
  ::waitpid(driver, nullptr, 0);
  REQUIRE(journal_lines(sweep.out) >= 6);
  CHECK(sweep.run().code == 0);
  CHECK(sweep.csv() == sweep.csv("whole"));
}

TEST_CASE("a job file of --slurm is one that a shell reads, and nothing is computed",
          "[cli][sweep]") {
  const Sweep sweep;
  const ProcessResult result = sweep.run({"--slurm", "8", "--time", "90"});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, StartsWith("#!/bin/sh\n") &&
                                ContainsSubstring("#SBATCH --array=1-8\n") &&
                                ContainsSubstring("#SBATCH --time=90\n") &&
                                ContainsSubstring("--shard \"$SLURM_ARRAY_TASK_ID/8\""));
  CHECK_FALSE(fs::exists(sweep.out));
  CHECK(run_process({"sh", "-n", sweep.folder.write("job.sh", result.output)}).code == 0);
  CHECK(sweep.run({"--slurm", "0"}).code == 2);
  CHECK(sweep.run({"--slurm", "8", "--time", "1h; rm -rf /"}).code == 2);
}

TEST_CASE("what sweep and merge cannot do is said, with status 2", "[cli][sweep]") {
  const Sweep sweep;
  for (const char* shard : {"0/4", "5/4", "x"})
    CHECK_THAT(sweep.run({"--shard", shard}).errors, ContainsSubstring(shard));
  CHECK(sweep.run({"--shard", "5/4"}).code == 2);
  CHECK(sweep.run({"--jobs", "0"}).code == 2);
  CHECK(tool({"sweep", sweep.file}).code == 2);  // no folder
  CHECK(tool({"merge"}).code == 2);
  CHECK(tool({"merge", sweep.folder / "none"}).code == 2);
  CHECK(tool({"merge", sweep.folder.path().string()}).code == 2);
  CHECK_FALSE(fs::exists(sweep.out));

  REQUIRE(sweep.run().code == 0);
  (void)sweep.folder.write("study.toml", study + "[[axis]]\nkey = \"noise.rms\"\nvalues = [0.1]\n");
  const ProcessResult other = sweep.run();
  CHECK(other.code == 2);
  CHECK_THAT(other.errors, ContainsSubstring("is the journal of another study"));
}

TEST_CASE("a report that is somebody's own stays", "[cli][sweep]") {
  const Sweep sweep;
  fs::create_directory(sweep.out);
  (void)sweep.folder.write("out/report.html", "mine");
  CHECK(sweep.run().code == 2);
  CHECK(read_text(sweep.out + "/report.html") == "mine");
  CHECK(sweep.run({"--force"}).code == 0);
  CHECK(read_text(sweep.out + "/report.html") != "mine");
}

TEST_CASE("the shipped study is one", "[cli][sweep]") {
  const Folder folder;
  const ProcessResult result =
      tool({"sweep", scene("sweeps/depth.toml"), "-o", folder / "out", "--shard", "7/50"});
  CAPTURE(result.errors);
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("shard 7/50: 2 points are done"));
  CHECK(tool({"run", scene("sweeps/pad.toml")}).code == 0);
}
