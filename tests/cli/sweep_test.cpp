// sweep and merge: parts, kills, and what is refused.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
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
  std::string study = folder.write("study.toml", depth_study);
  std::string file = folder / "rows.csv";
  std::string out = folder / "out";

  Sweep() { (void)folder.write("pad.toml", swept_pad); }
  [[nodiscard]] std::vector<std::string> command(const std::string& into = "rows.csv") const {
    return {"sweep", study, "-o", folder / into, "--jobs", "2"};
  }
  [[nodiscard]] ProcessResult run(std::vector<std::string> more = {},
                                  const std::string& into = "rows.csv") const {
    std::vector<std::string> arguments = command(into);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments);
  }
  /// results.csv of these files of rows.
  [[nodiscard]] std::string merged(const std::vector<std::string>& files = {"rows.csv"},
                                   const std::string& into = "out") const {
    std::vector<std::string> words = {"merge", "--out", folder / into};
    for (const std::string& name : files) words.push_back(folder / name);
    const ProcessResult result = run_tool(words);
    CAPTURE(result.errors);
    CHECK(result.code == 0);
    return read_text(fs::path(folder / into) / "results.csv");
  }
};

}  // namespace

TEST_CASE("sweep writes rows, merge their page, and both the hash", "[cli][sweep]") {
  const Sweep sweep;
  const ProcessResult result = sweep.run();
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  const std::vector<std::string> rows = lines_of(read_text(sweep.file));
  REQUIRE(rows.size() == 42);
  CHECK(rows[0].starts_with("tactile-net sweep 3,"));
  CHECK(rows[1].starts_with("row,index,sensor.depth,repeat,seed,method,alpha,verdict,error,"));
  const std::string csv = sweep.merged();
  std::string bare;  // the same without the first line and column
  for (std::size_t i = 1; i < rows.size(); ++i)
    bare += rows[i].substr(rows[i].find(',') + 1) + '\n';
  CHECK(csv == bare);
  CHECK_THAT(result.output, ContainsSubstring("SHA-256 of all rows: " + sha256_text(csv)));
  CHECK_THAT(result.output, ContainsSubstring("closed_form  20"));
  const std::string page = read_text(sweep.out + "/report.html");
  CHECK_THAT(page, ContainsSubstring("Depths") && ContainsSubstring("sensor.depth") &&
                       ContainsSubstring(sha256_text(csv)) &&
                       ContainsSubstring("href=\"results.csv\""));
  CHECK(fs::exists(sweep.out + "/error-1.csv"));
  CHECK_FALSE(fs::exists(sweep.out + "/alpha-1.csv"));  // the scene gives it

  const std::string before = read_text(sweep.file);
  const ProcessResult again = sweep.run();
  CHECK(again.code == 0);
  CHECK(again.output == result.output);
  CHECK(read_text(sweep.file) == before);
}

TEST_CASE("a sweep's JSON is what its rows come to, in the folder and where it is asked for",
          "[cli][sweep]") {
  const Sweep sweep;
  const ProcessResult first = sweep.run({"--json", "-"});
  CAPTURE(first.errors);
  REQUIRE(first.code == 0);
  const Json json = Json::parse(first.output);
  CHECK(json["kind"] == "sweep");
  CHECK(json["title"] == "Depths");
  CHECK(json["points"] == 20);
  CHECK(json["points_failed"] == 0);
  CHECK(json["points_resumed"] == 0);
  CHECK(json["results"]["rows"] == 40);
  CHECK(json["results"]["sha256"] == sha256_text(sweep.merged()));
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
      run_tool({"merge", sweep.file, "--out", sweep.folder / "m", "--json", "-"});
  CHECK(merged.output == read_text(sweep.folder / "m/result.json"));
  CHECK(Json::parse(merged.output)["points_resumed"].is_null());
  CHECK(Json::parse(merged.output)["methods"] == json["methods"]);
  const ProcessResult part = sweep.run({"--points", "0:10", "--json", "-"}, "part.csv");
  CHECK(part.code == 2);
  CHECK_THAT(part.errors, ContainsSubstring("give it to merge"));
  CHECK_FALSE(fs::exists(sweep.folder / "part.csv"));
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
  const std::string csv = sweep.merged();
  const std::string page = read_text(sweep.out + "/report.html");
  CHECK_THAT(page, ContainsSubstring("sensor.depth [mm]") && ContainsSubstring("noise.rms [kPa]") &&
                       ContainsSubstring("noise.rms = 0.01 kPa"));
  CHECK(csv.starts_with("index,sensor.depth,noise.rms,repeat,"));  // keys, bare
}

TEST_CASE("rows have what a study keeps, and its page draws what there is", "[cli][sweep]") {
  const Sweep sweep;
  (void)sweep.folder.write("study.toml", "keep = [\"readings\", \"force\"]\n" + depth_study);
  REQUIRE(sweep.run().code == 0);
  const std::string csv = sweep.merged();
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
  const ProcessResult merged = run_tool({"merge", sweep.file, "--out", sweep.out, "--json", "-"});
  CHECK_THAT(read_text(sweep.out + "/results.csv"), ContainsSubstring("sensor.depth must be > 0"));
  CHECK(merged.code == 1);
  CHECK_THAT(merged.errors, ContainsSubstring(why));
  CHECK(Json::parse(merged.output)["points_failed"] == 2);
  (void)sweep.folder.write("study.toml",
                           "scene = \"pad.toml\"\n"
                           "[[axis]]\nkey = \"sensor.depth\"\nvalues = [-1.0, 1.0]\n");
  CHECK(sweep.run({}, "half.csv").code == 0);
  // So has a part that has none; another has, and so has the whole.
  const ProcessResult part = sweep.run({"--points", "0:1"}, "parts.csv");
  CHECK(part.code == 1);
  CHECK_THAT(part.errors, ContainsSubstring(why));
  CHECK_THAT(part.output, ContainsSubstring("1 point is done"));
  CHECK(sweep.run({"--points", "1:2"}, "parts.csv").code == 0);
  CHECK(run_tool({"merge", sweep.folder / "parts.csv"}).code == 0);
}

TEST_CASE("parts are merged when all are there", "[cli][sweep]") {
  const Sweep sweep;
  REQUIRE(sweep.run().code == 0);
  const ProcessResult first = sweep.run({"--points", "0:7"}, "a.csv");
  CHECK(first.code == 0);
  CHECK_THAT(
      first.output,
      ContainsSubstring("7 points are done; when all 20 of the study are: tactile-net merge"));
  CHECK(sweep.run({"--points", "14:999"}, "b.csv").code == 0);
  const ProcessResult part =
      run_tool({"merge", sweep.folder / "a.csv", sweep.folder / "b.csv", "--out", sweep.out});
  CHECK(part.code == 1);
  CHECK_THAT(part.errors, ContainsSubstring("7 of 20 points are missing, 7:14"));
  CHECK_FALSE(fs::exists(sweep.out));
  CHECK(sweep.run({"--points", "7:14"}, "b.csv").code == 0);
  CHECK(sweep.merged({"a.csv", "b.csv"}) == sweep.merged({"rows.csv"}, "whole"));
}

namespace {

/// Sends a signal to the sweep once its file holds a few rows. @return  as waitpid has it
int ended_by(int signal, const Sweep& sweep) {
  std::vector<std::string> arguments = sweep.command();
  arguments.insert(arguments.begin(), TOOL);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const std::string errors = sweep.folder / "errors";
  const pid_t process = ::fork();
  REQUIRE(process >= 0);
  if (process == 0) {
    if (std::freopen(errors.c_str(), "w", stderr) != nullptr) ::execv(TOOL, argv.data());
    ::_exit(127);
  }
  const auto rows = [&] {
    return fs::exists(sweep.file) ? lines_of(read_text(sweep.file)).size() : 0;
  };
  for (int i = 0; i < 10'000 && rows() < 6; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(process, signal);
  int status = 0;
  ::waitpid(process, &status, 0);
  REQUIRE(rows() >= 6);
  return status;
}

}  // namespace

TEST_CASE("a sweep that is killed outright goes on, and ends the same", "[cli][sweep]") {
  const Sweep sweep;
  REQUIRE(sweep.run({}, "whole.csv").code == 0);
  (void)ended_by(SIGKILL, sweep);
  CHECK(sweep.run().code == 0);
  CHECK(read_text(sweep.file) == read_text(sweep.folder / "whole.csv"));
}

TEST_CASE("a wish to stop ends a sweep without success, and with whole rows", "[cli][sweep]") {
  const Sweep sweep;
  (void)sweep.folder.write("study.toml", replaced(depth_study, "repeats = 4", "repeats = 4000"));
  const int status = ended_by(SIGINT, sweep);
  CAPTURE(status);
  CHECK_FALSE((WIFEXITED(status) && WEXITSTATUS(status) == 0));
  CHECK_THAT(
      read_text(sweep.folder / "errors"),
      ContainsSubstring("stopped at") && ContainsSubstring("the same command continues from here"));
  CHECK(read_text(sweep.file).ends_with('\n'));
}

TEST_CASE("what sweep and merge cannot do is said, with status 2", "[cli][sweep]") {
  const Sweep sweep;
  for (const char* points : {"4:4", "5:4", "x", "20:30"}) {
    const ProcessResult result = sweep.run({"--points", points});
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring(std::string(points).substr(0, 2)));
  }
  CHECK(sweep.run({"--jobs", "0"}).code == 2);
  CHECK(run_tool({"sweep", sweep.study}).code == 2);  // no file
  CHECK_THAT(run_tool({"sweep", sweep.study, "-o", "-"}).errors,
             ContainsSubstring("must be a file"));
  CHECK(run_tool({"merge"}).code == 2);
  CHECK(run_tool({"merge", sweep.folder / "none"}).code == 2);
  CHECK(run_tool({"merge", sweep.folder.path().string()}).code == 2);
  CHECK(run_tool({"merge", sweep.study}).code == 2);
  CHECK_FALSE(fs::exists(sweep.file));

  const std::string study = read_text(sweep.study);
  const ProcessResult over = run_tool({"sweep", sweep.study, "-o", sweep.study});
  CHECK(over.code == 2);
  CHECK(read_text(sweep.study) == study);
  REQUIRE(sweep.run().code == 0);
  (void)sweep.folder.write("study.toml",
                           depth_study + "[[axis]]\nkey = \"noise.rms\"\nvalues = [0.1]\n");
  const ProcessResult other = sweep.run();
  CHECK(other.code == 2);
  CHECK_THAT(other.errors, ContainsSubstring("holds the rows of another study"));
}

TEST_CASE("a report that is somebody's own stays", "[cli][sweep]") {
  const Sweep sweep;
  REQUIRE(sweep.run().code == 0);
  fs::create_directory(sweep.out);
  (void)sweep.folder.write("out/report.html", "mine");
  CHECK(run_tool({"merge", sweep.file, "--out", sweep.out}).code == 2);
  CHECK(read_text(sweep.out + "/report.html") == "mine");
  CHECK(run_tool({"merge", sweep.file, "--out", sweep.out, "--force"}).code == 0);
  CHECK(read_text(sweep.out + "/report.html") != "mine");
}

TEST_CASE("the shipped study is one", "[cli][sweep]") {
  const Folder folder;
  const ProcessResult result =
      run_tool({"sweep", scene("sweeps/depth.toml"), "-o", folder / "rows.csv", "--points", "7:9"});
  CAPTURE(result.errors);
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("2 points are done"));
  CHECK(run_tool({"run", scene("sweeps/pad.toml")}).code == 0);
}
