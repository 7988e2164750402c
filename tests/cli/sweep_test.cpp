// sweep and merge: shards, kills, and what is refused.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tactile_net/numeric/sha256.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string swept_pad =
    "[sensor]\ncount = 41\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2.0\nforce = 1.0\n"
    "[noise]\nrms = 0.01\n"
    "[reconstruct]\nmethods = [\"tikhonov\", \"closed_form\"]\nalpha = 1e-3\n";

/// 20 points.
const std::string depth_study =
    "title = \"Depths\"\nscene = \"pad.toml\"\nrepeats = 4\n"
    "[[axis]]\nkey = \"sensor.depth\"\nfrom = 0.5\nto = 2.5\ncount = 5\n";

struct Sweep {
  Folder folder;
  std::string file = folder.write("study.toml", depth_study);
  std::string out = folder / "out";

  Sweep() { (void)folder.write("pad.toml", swept_pad); }
  [[nodiscard]] std::vector<std::string> command(const std::string& into = "out") const {
    return {"sweep", file, "-o", folder / into, "--jobs", "2"};
  }
  [[nodiscard]] ProcessResult run(std::vector<std::string> more = {},
                                  const std::string& into = "out") const {
    std::vector<std::string> arguments = command(into);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments);
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

TEST_CASE("a sweep's JSON is what its rows come to, in the folder and where it is asked for",
          "[cli][sweep]") {
  const Sweep sweep;
  const ProcessResult first = sweep.run({"--json", "-"});
  CAPTURE(first.errors);
  REQUIRE(first.code == 0);
  const Json json = Json::parse(first.output);
  CHECK(first.output == read_text(sweep.out + "/result.json"));
  CHECK(json["kind"] == "sweep");
  CHECK(json["title"] == "Depths");
  CHECK(json["points"] == 20);
  CHECK(json["points_failed"] == 0);
  CHECK(json["points_resumed"] == 0);
  CHECK(json["results"]["rows"] == 40);
  CHECK(json["results"]["sha256"] == sha256_text(sweep.csv()));
  CHECK(json["axes"].size() == 2);
  CHECK(json["axes"][0]["key"] == "sensor.depth");
  CHECK(json["axes"][0]["unit"].is_null());  // the scene states none
  REQUIRE(json["methods"].size() == 2);
  for (const Json& method : json["methods"]) {
    CHECK(method["rows"] == 20);
    REQUIRE(method["axes"].size() == 1);  // a repeat's number says nothing
    const Json& values = method["axes"][0]["values"];
    REQUIRE(values.size() == 5);
    CHECK(values[0]["value"] == "0.5");
    double largest = 0.0;
    for (const Json& value : values) {
      CHECK(value["rows"] == 4);
      largest = std::max(largest, value["largest_error"].get<double>());
    }
    CHECK(largest == method["largest_error"]);
  }

  const ProcessResult again = sweep.run({"--json", sweep.folder / "again.json"});
  CHECK(again.code == 0);
  CHECK_THAT(again.output, ContainsSubstring("SHA-256"));
  CHECK(Json::parse(read_text(sweep.folder / "again.json"))["points_resumed"] == 20);
  const ProcessResult merged =
      run_tool({"merge", sweep.out, "--out", sweep.folder / "m", "--json", "-"});
  CHECK(Json::parse(merged.output)["points_resumed"].is_null());
  CHECK(Json::parse(merged.output)["methods"] == json["methods"]);
  const ProcessResult part = sweep.run({"--shard", "1/2", "--json", "-"}, "part");
  CHECK(part.code == 2);
  CHECK_THAT(part.errors, ContainsSubstring("give it to merge"));
  CHECK_FALSE(fs::exists(sweep.folder / "part"));
}

TEST_CASE("the units that a scene states stand on a sweep's axes", "[cli][sweep]") {
  const Sweep sweep;
  (void)sweep.folder.write("pad.toml", "[units]\nlength = \"mm\"\nstress = \"kPa\"\n" + swept_pad);
  (void)sweep.folder.write("study.toml",
                           depth_study + "[[axis]]\nkey = \"noise.rms\"\nvalues = [0.01, 0.1]\n");
  const ProcessResult result = sweep.run({"--json", "-"});
  REQUIRE(result.code == 0);
  const Json json = Json::parse(result.output);
  CHECK(json["axes"][0]["unit"] == "mm");
  CHECK(json["axes"][1]["unit"] == "kPa");
  CHECK(json["axes"][2]["unit"].is_null());
  CHECK(json["units"]["force"] == "N/m");
  const std::string page = read_text(sweep.out + "/report.html");
  CHECK_THAT(page, ContainsSubstring("sensor.depth [mm]") && ContainsSubstring("noise.rms [kPa]") &&
                       ContainsSubstring("noise.rms = 0.01 kPa"));
  CHECK(sweep.csv().starts_with("index,sensor.depth,noise.rms,repeat,"));  // keys, bare
}

TEST_CASE("rows have what a study keeps, and its page draws what there is", "[cli][sweep]") {
  const Sweep sweep;
  (void)sweep.folder.write("study.toml", "keep = [\"readings\", \"force\"]\n" + depth_study);
  REQUIRE(sweep.run().code == 0);
  const std::string csv = sweep.csv();
  CHECK(
      csv.starts_with("index,sensor.depth,repeat,seed,method,verdict,force,failure,version,"
                      "instructions,readings\n"));
  const std::string last = csv.substr(csv.rfind(','));
  CHECK(std::count(last.begin(), last.end(), ' ') == 40);  // 41 taxels
  CHECK_FALSE(fs::exists(sweep.out + "/error-1.csv"));
}

TEST_CASE("a sweep without a single answer is written, and has failed", "[cli][sweep]") {
  const Sweep sweep;
  (void)sweep.folder.write("study.toml",
                           "scene = \"pad.toml\"\n"
                           "[[axis]]\nkey = \"sensor.depth\"\nvalues = [-1.0, -2.0]\n");
  const std::string why =
      "no point has an answer; the first, sensor.depth = -1: sensor.depth must be > 0";
  for (int i = 0; i < 2; ++i) {
    const ProcessResult result = sweep.run();
    CHECK(result.code == 1);
    CHECK_THAT(result.errors, ContainsSubstring(why));
    CHECK_THAT(result.output, ContainsSubstring("2 rows: sensor.depth must be > 0"));
  }
  CHECK(sweep.csv().find("sensor.depth must be > 0") != std::string::npos);
  const ProcessResult merged = run_tool({"merge", sweep.out, "--json", "-"});
  CHECK(merged.code == 1);
  CHECK_THAT(merged.errors, ContainsSubstring(why));
  CHECK(Json::parse(merged.output)["points_failed"] == 2);
  (void)sweep.folder.write("study.toml",
                           "scene = \"pad.toml\"\n"
                           "[[axis]]\nkey = \"sensor.depth\"\nvalues = [-1.0, 1.0]\n");
  CHECK(sweep.run({}, "half").code == 0);
  // So has a shard that has none; another has, and so has the whole.
  const ProcessResult shard = sweep.run({"--shard", "1/2"}, "shards");
  CHECK(shard.code == 1);
  CHECK_THAT(shard.errors, ContainsSubstring(why));
  CHECK_THAT(shard.output, ContainsSubstring("shard 1/2: 1 point is done"));
  CHECK(sweep.run({"--shard", "2/2"}, "shards").code == 0);
  CHECK(run_tool({"merge", sweep.folder / "shards"}).code == 0);
}

TEST_CASE("shards are merged when all are there, from one folder or from several", "[cli][sweep]") {
  const Sweep sweep;
  REQUIRE(sweep.run().code == 0);
  const ProcessResult first = sweep.run({"--shard", "1/3"}, "shared");
  CHECK(first.code == 0);
  CHECK_THAT(first.output, ContainsSubstring("shard 1/3: 7 points are done"));
  CHECK(sweep.run({"--shard", "2/3"}, "shared").code == 0);
  CHECK(sweep.run({"--shard", "3/3"}, "alone").code == 0);
  const ProcessResult part = run_tool({"merge", sweep.folder / "shared"});
  CHECK(part.code == 1);
  CHECK_THAT(part.errors, ContainsSubstring("6 of 20 points are missing, 2 first"));
  CHECK_FALSE(fs::exists(sweep.folder / "shared/results.csv"));
  const ProcessResult all = run_tool(
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
  CHECK_THAT(sweep.run({"--slurm", "8", "--shard", "1/2"}).errors, ContainsSubstring("--shard: "));
  CHECK_THAT(sweep.run({"--time", "90"}).errors, ContainsSubstring("give --slurm"));
}

TEST_CASE("a task of a job file does what the sweep would with the same options", "[cli][sweep]") {
  const Folder folder;
  for (const char* name : {"pads", "my studies", "bin"}) fs::create_directory(folder / name);
  (void)folder.write("pads/pad.toml", swept_pad);
  const std::string file =
      folder.write("my studies/a;b.toml",
                   replaced(depth_study, "scene = \"pad.toml\"", "scene = \"../pads/pad.toml\""));
  const std::string ngspice = folder / "my ngspice";
  const auto sweep = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"sweep",        file,      "-o",        folder / out,
                                      "--jobs",       "2",       "--force",   "--allow-outside",
                                      "--simulator",  "process", "--ngspice", ngspice,
                                      "--time-limit", "7.5"};
    words.insert(words.end(), more.begin(), more.end());
    return run_tool(words);
  };
  const ProcessResult script = sweep("out's", {"--slurm", "2"});
  REQUIRE(script.code == 0);
  CHECK_THAT(script.output, ContainsSubstring("#SBATCH --cpus-per-task=2\n"));
  const std::string job = folder.write("job.sh", script.output);
  // In the program's place one that says which words it is given.
  const std::string fake = folder.write("bin/tactile-net", "#!/bin/sh\nprintf '%s\\n' \"$@\"\n");
  fs::permissions(fake, fs::perms::owner_all);
  for (const char* task : {"1", "2"}) {
    const ProcessResult said =
        run_process({"env", "PATH=" + (folder / "bin") + ":" + std::getenv("PATH"),
                     std::string("SLURM_ARRAY_TASK_ID=") + task, "sh", job});
    REQUIRE(said.code == 0);
    const std::vector<std::string> words = lines_of(said.output);
    for (const std::string& word :
         {std::string("--force"), std::string("--allow-outside"), ngspice, std::string("7.5")})
      CHECK(std::count(words.begin(), words.end(), word) == 1);
    CHECK(run_tool(words).code == 0);
  }
  CHECK(run_tool({"merge", folder / "out's"}).code == 0);
  CHECK(sweep("whole", {}).code == 0);
  CHECK(read_text(folder / "out's/results.csv") == read_text(folder / "whole/results.csv"));

  // The line that a part of a sweep ends with is one that a shell reads, whatever the folder's
  // name.
  const ProcessResult part = sweep("a part", {"--shard", "1/2"});
  const std::string line = part.output.substr(part.output.find("tactile-net merge"));
  const ProcessResult typed = run_process(
      {"env", "PATH=" + (folder / "bin") + ":" + std::getenv("PATH"), "sh", "-c", line});
  CHECK(lines_of(typed.output) == std::vector<std::string>{"merge", folder / "a part"});
}

TEST_CASE("what sweep and merge cannot do is said, with status 2", "[cli][sweep]") {
  const Sweep sweep;
  for (const char* shard : {"0/4", "5/4", "x"})
    CHECK_THAT(sweep.run({"--shard", shard}).errors, ContainsSubstring(shard));
  CHECK(sweep.run({"--shard", "5/4"}).code == 2);
  CHECK(sweep.run({"--jobs", "0"}).code == 2);
  CHECK(run_tool({"sweep", sweep.file}).code == 2);  // no folder
  CHECK(run_tool({"merge"}).code == 2);
  CHECK(run_tool({"merge", sweep.folder / "none"}).code == 2);
  CHECK(run_tool({"merge", sweep.folder.path().string()}).code == 2);
  CHECK_FALSE(fs::exists(sweep.out));

  REQUIRE(sweep.run().code == 0);
  (void)sweep.folder.write("study.toml",
                           depth_study + "[[axis]]\nkey = \"noise.rms\"\nvalues = [0.1]\n");
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
      run_tool({"sweep", scene("sweeps/depth.toml"), "-o", folder / "out", "--shard", "7/50"});
  CAPTURE(result.errors);
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("shard 7/50: 2 points are done"));
  CHECK(run_tool({"run", scene("sweeps/pad.toml")}).code == 0);
}
