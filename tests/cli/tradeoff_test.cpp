// The command `tradeoff`: what accuracy costs in time.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
using Json = nlohmann::json;

namespace {

const std::string pressed_line = R"(
[sensor]
count = 21
pitch = 0.5
depth = 1.0
reads = ["strain_x"]
[material]
youngs_modulus = 1.0
poisson_ratio = 0.45
[[contact]]
shape = "cylinder"
half_width = 2.0
force = 1.0
[reconstruct]
alpha = 1e-3
)";

/// What does not depend on the clock.
std::vector<std::string> timeless_points(const Json& study) {
  std::vector<std::string> text;
  for (const Json& job : study.at("jobs"))
    for (const Json& point : job.at("points"))
      text.push_back(point.at("curve").get<std::string>() + point.at("knob").get<std::string>() +
                     point.at("error_to_solution").dump() + point.at("error_to_truth").dump());
  return text;
}

}  // namespace

TEST_CASE("a study of the arithmetic is complete, plausible, and the same but for its times",
          "[cli][tradeoff]") {
  const Folder folder;
  const std::string file = folder.write("scene.toml", pressed_line);
  const ProcessResult result =
      run_tool({"tradeoff", file, "--digital", "--out", folder / "a", "--accuracy", "1e-3"});
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("for 1 % error within 1 ms: ") &&
                                ContainsSubstring("asked for 0.1 % error: "));
  const Json study = Json::parse(read_text(folder / "a/tradeoff.json"));
  CHECK(study.at("complete") == true);
  CHECK(study.at("reference_agreement").get<double>() < 1e-12);

  std::set<std::string> curves;
  double coarse = 1.0;
  for (const Json& job : study.at("jobs"))
    for (const Json& point : job.at("points")) {
      CAPTURE(point.dump());
      curves.insert(point.at("curve"));
      REQUIRE(point.at("failure") == "");
      CHECK(point.at("seconds").at("low") <= point.at("seconds").at("median"));
      CHECK(point.at("seconds").at("median") <= point.at("seconds").at("high"));
      CHECK(point.at("seconds").at("median").get<double>() > 0.0);
      if (point.at("curve") == "dense float64" || point.at("curve") == "closed form (ch. 4)")
        CHECK(point.at("error_to_solution").get<double>() < 1e-10);
      if (point.at("curve") == "conjugate gradients, FFT" && point.at("knob") == "1 steps")
        coarse = point.at("error_to_solution").get<double>();
    }
  CHECK(coarse > 1e-3);  // one step is not the answer
  for (const char* curve : {"reflections float64", "reflections low rank float64", "dense float32",
                            "FFT, array as a ring", "FFT, ends corrected", "dft: division (ch. 3)",
                            "QR of every frame", "f_v >= 0, active set", "fewer taxels",
                            "readings by the integral", "readings by the discrete sum"})
    CHECK(curves.contains(curve));

  for (const char* name : {"report.html", "tradeoff.csv", "error-to-solution.csv"})
    CHECK(std::filesystem::file_size((folder / "a/") + name) > 500);
  REQUIRE(run_tool({"tradeoff", file, "--digital", "--out", folder / "b"}).code == 0);
  CHECK(timeless_points(study) ==
        timeless_points(Json::parse(read_text(folder / "b/tradeoff.json"))));
}

TEST_CASE("circuits settle in the time that bandwidth and error ask for", "[cli][tradeoff]") {
  const Folder folder;
  const ProcessResult result =
      run_tool({"tradeoff", folder.write("scene.toml", pressed_line), "--out", folder / "out"});
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("with op-amps of 10 MHz, settles to 1 % in") &&
                                ContainsSubstring("beats this machine from") &&
                                ContainsSubstring("with parts of 1 %"));
  std::map<std::string, std::map<double, double>> settling;
  const Json study = Json::parse(read_text(folder / "out/tradeoff.json"));
  for (const Json& job : study.at("jobs"))
    for (const Json& point : job.at("points"))
      if (point.at("time_of") == "settling" && point.at("failure") == "")
        settling[point.at("curve")][point.at("error_to_solution")] =
            point.at("seconds").at("median");
  REQUIRE(settling.contains("crossbar, 10 MHz"));
  REQUIRE(settling.contains("ideal, 10 pF a node"));
  for (const auto& [curve, times] : settling) {
    CAPTURE(curve);
    double before = std::numeric_limits<double>::infinity();
    for (const auto& [error, seconds] : times) {  // a smaller error takes longer
      CHECK(seconds <= before);
      before = seconds;
    }
  }
}

TEST_CASE("a demand that nothing meets fails and says what would be", "[cli][tradeoff]") {
  const Folder folder;
  const ProcessResult result = run_tool({"tradeoff", folder.write("scene.toml", pressed_line),
                                         "--digital", "--deadline", "1ns", "--accuracy", "1e-9"});
  CHECK(result.code == 1);
  CHECK_THAT(result.output, ContainsSubstring("none meets both; accurate enough, and fastest"));
  CHECK_THAT(result.errors, ContainsSubstring("no method meets the demand"));
}

TEST_CASE("Ctrl-C leaves a valid part, and --resume goes on from it", "[cli][tradeoff]") {
  const Folder folder;
  const std::string file = folder.write("scene.toml", pressed_line);
  const std::string out = folder / "out";
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::setpgid(0, 0);
    ::close(STDOUT_FILENO);
    ::close(STDERR_FILENO);
    ::execl(TOOL, TOOL, "tradeoff", file.c_str(), "--out", out.c_str(), nullptr);
    ::_exit(127);
  }
  const std::string json = out + "/tradeoff.json";
  for (int i = 0; i < 3000 && !std::filesystem::exists(json); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  ::kill(-child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  const Json part = Json::parse(read_text(json));
  const bool stopped = part.at("complete") == false;
  CHECK(WEXITSTATUS(status) == (stopped ? 1 : 0));  // a fast machine may have been done
  CHECK(std::filesystem::exists(out + "/report.html"));

  const ProcessResult resumed = run_tool({"tradeoff", file, "--out", out, "--resume"});
  CAPTURE(resumed.errors);
  REQUIRE(resumed.code == 0);
  const Json whole = Json::parse(read_text(json));
  CHECK(whole.at("complete") == true);
  CHECK(whole.at("jobs").size() >= part.at("jobs").size());
  CHECK(whole.at("jobs").at(0) == part.at("jobs").at(0));  // not measured again

  folder.write("scene.toml", pressed_line + "# another\n");
  const ProcessResult other = run_tool({"tradeoff", file, "--out", out, "--resume"});
  CHECK(other.code == 2);
  CHECK_THAT(other.errors, ContainsSubstring("it was made for another scene"));
}

TEST_CASE("a study's bad options are refused", "[cli][tradeoff]") {
  const Folder folder;
  const std::string file = folder.write("scene.toml", pressed_line);
  const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
    const ProcessResult result = run_tool(arguments);
    CAPTURE(result.errors);
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring(why));
  };
  refused({"tradeoff", file, "--deadline", "soon"}, "is not a time > 0");
  refused({"tradeoff", file, "--deadline", "-1ms"}, "is not a time > 0");
  refused({"tradeoff", file, "--deadline", ""}, "is not a time > 0");
  refused({"tradeoff", file, "--deadline", "inf"}, "is not a time > 0");
  refused({"tradeoff", file, "--digital", "--json", folder / "no/x.json"}, "cannot be created");
  refused({"tradeoff", file, "--accuracy", "0"}, "accuracy must be > 0");
  refused({"tradeoff", file, "--resume"}, "needs --out");
  refused({"tradeoff", folder.write("unloaded.toml", small_scene)}, "every reading is zero");
  refused({"tradeoff", file, "--digital", "--out", file}, "cannot be created as a folder");
}

TEST_CASE("a study that cannot be saved ends with the reason", "[cli][tradeoff]") {
  const Folder folder;
  std::filesystem::create_directories(folder / "out/tradeoff.json");
  const ProcessResult result = run_tool(
      {"tradeoff", folder.write("s.toml", pressed_line), "--digital", "--out", folder / "out"});
  CHECK(result.end == ProcessResult::End::exited);
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, ContainsSubstring("tradeoff.json: error: is a folder"));
}

TEST_CASE("a study needs its simulator from the start, and --resume tries again what failed",
          "[cli][tradeoff]") {
  const Folder folder;
  const std::string file = folder.write("s.toml", pressed_line);
  const ProcessResult without = run_tool({"tradeoff", file, "--ngspice", "no-such-ngspice"});
  CHECK(without.code == 1);
  CHECK_THAT(without.errors, ContainsSubstring("not installed") && ContainsSubstring("--digital"));

  const std::string out = folder / "out";
  REQUIRE(run_tool({"tradeoff", file, "--digital", "--out", out}).code == 0);
  Json study = Json::parse(read_text(out + "/tradeoff.json"));
  const std::string kept = study.at("jobs").at(0).dump();
  study.at("jobs").at(1).at("points").at(0).at("failure") = "the machine was asleep";
  folder.write("out/tradeoff.json", study.dump());
  REQUIRE(run_tool({"tradeoff", file, "--digital", "--out", out, "--resume"}).code == 0);
  study = Json::parse(read_text(out + "/tradeoff.json"));
  CHECK(study.at("jobs").at(0).dump() == kept);
  CHECK(study.at("jobs").at(1).at("points").at(0).at("failure") == "");
}

TEST_CASE("three taxels: what the first instant reaches takes no time, and is no failure",
          "[cli][tradeoff]") {
  const Folder folder;
  std::string three = pressed_line;
  three.replace(three.find("count = 21"), 10, "count = 3");
  three.replace(three.find("half_width = 2.0"), 16, "half_width = 0.5");
  const ProcessResult result = run_tool({"tradeoff", folder.write("s.toml", three), "--json", "-"});
  REQUIRE(result.code == 0);
  const Json study = Json::parse(result.output);
  std::set<std::string> settling;
  for (const Json& job : study.at("jobs"))
    for (const Json& point : job.at("points"))
      if (point.at("time_of") == "settling") {
        CAPTURE(point.dump());
        CHECK(point.at("failure") == "");
        CHECK(point.at("seconds").at("median").get<double>() >
              1e-10);  // no artefact of a step's edge
        settling.insert(point.at("curve"));
      }
  for (const char* curve : {"nic, 10 MHz", "rail, 1 MHz", "crossbar, 100 MHz"})
    CHECK(settling.contains(curve));
}

TEST_CASE("a family of methods that fails is listed, and leaves the others", "[cli][tradeoff]") {
  const Folder folder;
  std::string shallow = pressed_line;
  shallow.replace(shallow.find("depth = 1.0"), 11, "depth = 1e-5");
  shallow.replace(shallow.find("\"strain_x\""), 10, "\"shear_xy\", \"stress_x\"");
  shallow += "[forward]\nmodel = \"sampled\"\n";
  const ProcessResult result = run_tool({"tradeoff", folder.write("s.toml", shallow), "--digital"});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("left out: forward model: ") &&
                                ContainsSubstring("the integral is known only to"));
}

TEST_CASE("a study says which problem it studied", "[cli][tradeoff]") {
  const Folder folder;
  const ProcessResult result = run_tool(
      {"tradeoff", folder.write("s.toml", pressed_line + "nonnegative = true\n"), "--digital"});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("is that without the scene's constraints"));
  std::string noise = pressed_line;
  noise.erase(noise.find("[[contact]]"), noise.find("[reconstruct]") - noise.find("[[contact]]"));
  const ProcessResult silent =
      run_tool({"tradeoff", folder.write("n.toml", noise + "[noise]\nrms = 1e-3\n"), "--digital"});
  CHECK(silent.code == 0);
  CHECK_THAT(silent.output, ContainsSubstring("the scene has no contact"));
}

TEST_CASE("a skin's study has its methods, arrays of other sizes, circuits, and a page",
          "[cli][tradeoff][skin][long]") {
  const Folder folder;
  const std::string path = std::string(SCENES) + "/skins/circuit.toml";
  const ProcessResult result = run_tool({"tradeoff", path, "--out", folder / "out"});
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.output,
             ContainsSubstring("a frame on arrays of other sizes:") &&
                 ContainsSubstring("in a loop of 1 kHz a frame of 16 x 16 such taxels takes ") &&
                 ContainsSubstring("; one of 32 x 32 such taxels takes ") &&
                 ContainsSubstring("a circuit of two arrays with op-amps of 10 MHz settles"));
  const Json study = Json::parse(read_text(folder / "out/tradeoff.json"));
  CHECK(study.at("complete") == true);
  CHECK(study.at("units").at("force") == "N");
  std::set<std::string> curves;
  std::map<std::string, std::map<double, double>> settling;
  std::map<std::string, double> sizes;  // of circuits
  for (const Json& job : study.at("jobs"))
    for (const Json& point : job.at("points")) {
      CAPTURE(point.dump());
      const std::string curve = point.at("curve");
      const double seconds = point.at("seconds").at("median").get<double>();
      if (point.at("failure") != "") continue;
      curves.insert(curve);
      CHECK(seconds > 0.0);
      if (point.at("time_of") != "settling") continue;
      if (job.at("job") == "circuits over array sizes")
        sizes[point.at("knob")] = seconds;
      else
        settling[curve][point.at("error_to_solution")] = seconds;
    }
  for (const char* curve :
       {"dense float64", "reflections float64", "reflections float32", "singular values, any alpha",
        "QR of every frame", "sum of Kronecker products", "conjugate gradients, FFT",
        "conjugate gradients, matrix", "constraints, ADMM"})
    CHECK(curves.contains(curve));
  REQUIRE(settling.contains("least_squares, 10 MHz"));
  REQUIRE(settling.contains("lattice, 10 MHz"));
  for (const auto& [curve, times] : settling) {
    double before = std::numeric_limits<double>::infinity();
    for (const auto& [error, seconds] : times) {  // a smaller error takes longer
      CHECK(seconds <= before);
      before = seconds;
    }
  }
  // ngspice on the scene's own array, and the poles of the same array among the others.
  REQUIRE(sizes.contains("4 x 4 taxels"));
  CHECK_THAT(sizes.at("4 x 4 taxels"),
             WithinRel(settling.at("least_squares, 10 MHz").at(0.01), 0.05));

  for (const char* name :
       {"report.html", "tradeoff.csv", "error-to-solution.csv", "array-sizes.csv"})
    CHECK(std::filesystem::file_size((folder / "out/") + name) > 300);
  CHECK_THAT(read_text(folder / "out/report.html"),
             ContainsSubstring("Larger and smaller arrays") && ContainsSubstring("such taxels, ") &&
                 !ContainsSubstring("nan"));
  const ProcessResult again = run_tool({"tradeoff", path, "--out", folder / "out", "--resume"});
  REQUIRE(again.code == 0);
  CHECK(Json::parse(read_text(folder / "out/tradeoff.json")).at("jobs") == study.at("jobs"));
}

TEST_CASE("a skin's study takes a demand, and refuses what it cannot study",
          "[cli][tradeoff][skin][long]") {
  const Folder folder;
  const std::string path = std::string(SCENES) + "/skins/circuit.toml";
  const ProcessResult met =
      run_tool({"tradeoff", path, "--digital", "--deadline", "1s", "--accuracy", "1e-6"});
  CHECK(met.code == 0);
  CHECK_THAT(met.output, ContainsSubstring("asked for 1e-06 error within 1 s: "));
  const ProcessResult unmet =
      run_tool({"tradeoff", path, "--digital", "--deadline", "1ns", "--accuracy", "1e-9"});
  CHECK(unmet.code == 1);
  CHECK_THAT(unmet.output, ContainsSubstring("none meets both"));
  std::string scene = read_text(path);
  scene.erase(scene.find("[[contact]]"), scene.find("[noise]") - scene.find("[[contact]]"));
  scene.erase(scene.find("[noise]"), scene.find("[reconstruct]") - scene.find("[noise]"));
  const ProcessResult silent =
      run_tool({"tradeoff", folder.write("silent.toml", scene), "--digital"});
  CHECK(silent.code == 2);
  CHECK_THAT(silent.errors, ContainsSubstring("every reading is zero"));
  scene.replace(scene.find("columns = 4"), 11, "columns = 0");
  const ProcessResult wrong =
      run_tool({"tradeoff", folder.write("wrong.toml", scene), "--digital"});
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.errors, ContainsSubstring("wrong.toml:") && ContainsSubstring("columns"));
}
