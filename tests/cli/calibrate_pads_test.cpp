// Logs that no pad gives, and a log that tells little.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/cli/csv.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Json = nlohmann::json;

}  // namespace

TEST_CASE("logs that no pad gives are not taken for one", "[cli][calibrate]") {
  const std::vector<std::string> lines = lines_of(read_text(scene("calibration/rod-layer.csv")));
  const auto log_with = [&](const std::function<void(std::vector<std::string>&)>& edit) {
    std::string log = lines[0] + '\n';
    for (std::size_t i = 1; i < lines.size(); ++i) {
      std::vector<std::string> fields = fields_of(lines[i]);
      edit(fields);
      for (std::size_t k = 0; k < fields.size(); ++k) log += (k > 0 ? "," : "") + fields[k];
      log += '\n';
    }
    return log;
  };
  const Folder folder;
  const auto ends = [&](const std::string& log) {
    const ProcessResult result =
        run_tool({"calibrate", folder.write("log.csv", log), "--scene",
                  scene("calibration/rod-layer.toml"), "-o", folder / "none.toml"});
    CAPTURE(result.output, result.errors);
    CHECK((result.code == 1 || result.code == 2));
    CHECK_FALSE(std::filesystem::exists(folder / "none.toml"));
    return result.output + result.errors;
  };
  constexpr std::size_t first = 8;
  // Two columns for each other: the gains of no rods read so.
  ends(log_with([](auto& fields) { std::swap(fields[first + 14], fields[first + 26]); }));
  // The columns from the other end.
  CHECK_THAT(
      ends(log_with([](auto& fields) { std::reverse(fields.begin() + first, fields.end()); })),
      ContainsSubstring("position"));
  // Positions in millimetres, in a scene in metres.
  CHECK_THAT(ends(log_with([](auto& fields) {
               if (!fields[4].empty()) fields[4] = shortest(1e3 * std::stod(fields[4]));
             })),
             ContainsSubstring("position"));
}

TEST_CASE("one press identifies neither the depth nor a gain", "[cli][calibrate]") {
  std::string log;
  const std::vector<std::string> lines = lines_of(read_text(scene("calibration/rod-layer.csv")));
  for (std::size_t i = 0; i < 22; ++i) log += lines[i] + '\n';
  const Folder folder;
  const ProcessResult result = run_tool({"calibrate", folder.write("log.csv", log), "--scene",
                                         scene("calibration/rod-layer.toml"), "--json", "-"});
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  const Json json = Json::parse(result.output);
  INFO(json["parameters"]["depth"].dump());
  CHECK(json["parameters"]["depth"]["verdict"] != "identified");
  for (const Json& gain : json["gains"]) CHECK(gain["verdict"] != "identified");
}

TEST_CASE("pads of finite elements, pressed at one place, are calibrated",
          "[cli][calibrate][long]") {
  // The presses start with equal widths, and tell the depth only after those are fitted. Gains 10
  // % up and 5 % apart, the depth stated a quarter too small.
  struct Pad {
    const char* name;
    std::size_t taxels, presses;
    double pitch, depth, thickness;
    const char* calibrate;
    double noise[2];  // of stress_x and shear_xy
  };
  const Pad pads[] = {
      {"thin-pad", 41, 4, 0.5e-3, 3e-3, 3e-3, "at_base = true\n", {52.7, 25.1}},
      {"thick-pad", 61, 3, 0.4e-3, 1.5e-3, 25e-3, "", {43.2, 18.7}},
  };
  for (const Pad& pad : pads) {
    CAPTURE(pad.name);
    const std::string recorded = std::string("recorded/") + pad.name;
    const std::vector<std::string> frames = lines_of(read_text(scene(recorded + ".csv")));
    const std::vector<std::string> truth = lines_of(read_text(scene(recorded + ".truth.csv")));
    const std::size_t readings = 2 * pad.taxels;
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    std::vector<double> gains(readings);
    for (double& gain : gains) gain = 1.1 * (1.0 + 0.05 * normal(random));
    std::string names;
    for (const char* quantity : {"stress_x_", "shear_xy_"})
      for (std::size_t i = 0; i < pad.taxels; ++i) names += ',' + (quantity + std::to_string(i));
    std::string log =
        "press,shape,force,force_sd,position,position_sd,radius,half_width" + names + '\n';
    std::string counts = "t" + names + '\n';
    for (int rest = 0; rest < 24; ++rest) {
      log += "0,none,,,,,,";
      for (std::size_t j = 0; j < readings; ++j)
        log += ',' + shortest(gains[j] * pad.noise[j / pad.taxels] * normal(random));
      log += '\n';
    }
    std::vector<double> forces;
    for (std::size_t press = 1; press <= pad.presses; ++press) {
      const std::vector<std::string> fields = fields_of(frames[press]);
      forces.push_back(std::stod(fields_of(truth[press])[1]));
      log += std::to_string(press) + ",cylinder," +
             shortest(forces.back() * (1.0 + 0.005 * normal(random))) + ',' +
             shortest(0.005 * forces.back()) + ",1e-3,1e-4,,";
      std::string row;
      for (std::size_t j = 0; j < readings; ++j)
        row += ',' + shortest(gains[j] * std::stod(fields[1 + j]));
      log += row + '\n';
      counts += shortest(0.01 * static_cast<double>(press)) + row + '\n';
    }
    const std::string nominal = "[sensor]\ncount = " + std::to_string(pad.taxels) +
                                "\npitch = " + shortest(pad.pitch) +
                                "\ndepth = " + shortest(0.75 * pad.depth) +
                                "\nreads = [\"stress_x\", \"shear_xy\"]\n"
                                "[material]\nyoungs_modulus = 0.2e6\npoisson_ratio = 0.45\n"
                                "layer = { thickness = " +
                                shortest(*pad.calibrate ? 0.75 * pad.thickness : pad.thickness) +
                                ", base = \"bonded\" }\n[reconstruct]\nnonnegative = true\n"
                                "[calibrate]\ndepth_sd = \"unknown\"\n" +
                                pad.calibrate;
    const Folder folder;
    const std::string calibrated = folder / "calibrated.toml";
    const ProcessResult fit = run_tool({"calibrate", folder.write("log.csv", log), "--scene",
                                        folder.write("nominal.toml", nominal), "-o", calibrated,
                                        "--json", folder / "fit.json"});
    CAPTURE(fit.output, fit.errors);
    REQUIRE(fit.code == 0);
    const Json depth = Json::parse(read_text(folder / "fit.json"))["parameters"]["depth"];
    const double found = depth["value"].get<double>();
    CAPTURE(depth.dump());
    CHECK(depth["verdict"] == "identified");
    CHECK(std::abs(found - pad.depth) < 3.0 * depth["sd"].get<double>());
    CHECK(std::abs(found / pad.depth - 1.0) < 0.03);
    // What it buys: from the second frame on the force within 2 % instead of 11.
    const ProcessResult solved =
        run_tool({"solve", calibrated, "--readings", folder.write("counts.csv", counts), "-q", "-o",
                  folder / "tractions.csv", "--uncertainty", folder / "forces.csv"});
    CAPTURE(solved.errors);
    REQUIRE(solved.code == 0);
    const std::vector<std::string> answers = lines_of(read_text(folder / "forces.csv"));
    const std::vector<std::string> header = fields_of(answers[0]);
    const auto column = static_cast<std::size_t>(
        std::find(header.begin(), header.end(), "normal_force") - header.begin());
    REQUIRE(column < header.size());
    for (std::size_t i = 1; i < forces.size(); ++i) {
      const double force = std::stod(fields_of(answers[1 + i])[column]);
      CAPTURE(i, force, forces[i]);
      CHECK(std::abs(force / forces[i] - 1.0) < 0.02);
    }
  }
}
