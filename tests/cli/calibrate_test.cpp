#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/cli/calibration_logs.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Json = nlohmann::json;

/// The scene of a log with a table [calibrate] added, and the JSON of its calibration.
Json calibrated_with(const std::string& name, const std::string& table,
                     std::vector<std::string> options = {}) {
  const Folder folder;
  const std::string toml =
      folder.write("pad.toml", read_text(nominal_of(name)) + "\n[calibrate]\n" + table);
  options.insert(options.begin(), {"calibrate", log_of(name), "--scene", toml, "--json", "-"});
  const ProcessResult result = run_tool(options);
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  return Json::parse(result.output);
}

/// What the reference estimator had: nothing is stated of depth, thickness and E.
const std::string nothing_stated =
    "depth_sd = \"unknown\"\nthickness_sd = \"unknown\"\nyoungs_modulus_sd = \"unknown\"\n";

/// A reference within 0.3 of its sd, the truth within 3.
void check_value(const Json& json, const std::string& parameter, double reference, double sd,
                 double truth) {
  const double value = json["parameters"][parameter]["value"];
  const double own_sd = json["parameters"][parameter]["sd"];
  CAPTURE(parameter, value, own_sd);
  CHECK(std::abs(value - reference) <= 0.3 * sd);
  CHECK(std::abs(value - truth) <= 3.0 * own_sd);
}

double line_gains_left(const Json& json, const std::string& name) {
  return gains_left(json, truth_of(name)["gains"].begin().value());
}

std::string verdict(const Json& json, const std::string& parameter) {
  return json["parameters"][parameter]["verdict"];
}

/// A log with one line changed: `edit` gets its fields.
template <class Edit>
std::string edited_line(const std::string& name, std::size_t line, const Edit& edit) {
  const std::string text = read_text(log_of(name));
  std::string result;
  std::size_t number = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = text.find('\n', from);
    std::string row = text.substr(from, end - from);
    if (++number == line) {
      std::vector<std::string> fields(1);
      for (const char c : row) {
        if (c == ',')
          fields.emplace_back();
        else
          fields.back() += c;
      }
      edit(fields);
      row.clear();
      for (const std::string& field : fields)
        row += (row.empty() && &field == &fields[0] ? "" : ",") + field;
    }
    result += row + '\n';
    from = end + 1;
  }
  return result;
}

}  // namespace

TEST_CASE("a layer's depth, thickness and gains are found from rods", "[cli][calibrate]") {
  const Json json = calibrated_with("rod-layer", nothing_stated);
  check_value(json, "depth", 1.543e-3, 0.042e-3, 1.62e-3);
  check_value(json, "thickness", 3.44e-3, 0.12e-3, 3.3e-3);
  check_value(json, "poisson_ratio", 0.453, 0.024, 0.46);
  CHECK(std::abs(json["fit"]["rms"].get<double>() - 0.98) < 0.01);
  CHECK(line_gains_left(json, "rod-layer") <= 0.020);
  CHECK(verdict(json, "youngs_modulus") == "not_identifiable");
}

TEST_CASE("rods of known radius tell a half plane's modulus from strains", "[cli][calibrate]") {
  const Json json = calibrated_with("strain-rods", nothing_stated + "half_width_sd = 0\n");
  check_value(json, "depth", 1.504e-3, 0.005e-3, 1.5e-3);
  check_value(json, "poisson_ratio", 0.4309, 0.0010, 0.43);
  check_value(json, "youngs_modulus", 0.2597e6, 0.0016e6, 0.26e6);
  CHECK(std::abs(json["mean_gains"]["strain_x"]["value"].get<double>() - 0.9) < 0.009);
  CHECK(line_gains_left(json, "strain-rods") <= 0.012);
}

TEST_CASE("without a force all but the common gain is found", "[cli][calibrate]") {
  const Json json = calibrated_with("no-loads", nothing_stated);
  check_value(json, "depth", 1.508e-3, 0.017e-3, 1.5e-3);
  check_value(json, "thickness", 2.994e-3, 0.039e-3, 3.0e-3);
  check_value(json, "poisson_ratio", 0.448, 0.010, 0.45);
  CHECK(verdict(json, "youngs_modulus") == "not_identifiable");
  CHECK(json["mean_gains"]["stress_x"]["verdict"] == "not_identifiable");
  CHECK(line_gains_left(json, "no-loads") <= 0.023);
}

TEST_CASE("presses at one place say nothing of the far gains", "[cli][calibrate]") {
  const Json json = calibrated_with("one-place", nothing_stated);
  check_value(json, "depth", 1.476e-3, 0.053e-3, 1.5e-3);
  for (std::size_t j = 0; j < 41; ++j) {
    CAPTURE(j);
    const bool identified = json["gains"][j]["verdict"] == "identified";
    if (j <= 13 || j >= 28) CHECK_FALSE(identified);
    if (j >= 15 && j <= 26) CHECK(identified);
  }
}

TEST_CASE("finite elements with rods of known radius are explained", "[cli][calibrate]") {
  const Json json = calibrated_with("fe-rods", nothing_stated + "half_width_sd = 0\n");
  check_value(json, "depth", 1.524e-3, 0.016e-3, 1.5e-3);
  check_value(json, "youngs_modulus", 0.231e6, 0.013e6, 0.2e6);
  CHECK(std::abs(json["fit"]["rms"].get<double>() - 1.02) < 0.01);
  CHECK(line_gains_left(json, "fe-rods") <= 0.024);
}

TEST_CASE("finite elements without the radius are explained", "[cli][calibrate]") {
  std::string text = read_text(log_of("fe-rods"));
  for (const char* radius : {"0.002", "0.004", "0.006"})
    for (std::size_t at; (at = text.find("," + std::string(radius) + ",,")) != std::string::npos;)
      text.erase(at + 1, std::string(radius).size());
  const Folder folder;
  const std::string toml = folder.write(
      "pad.toml", read_text(nominal_of("fe-rods")) + "\n[calibrate]\n" + nothing_stated);
  const ProcessResult result =
      run_tool({"calibrate", folder.write("log.csv", text), "--scene", toml, "--json", "-"});
  REQUIRE(result.code == 0);
  const Json json = Json::parse(result.output);
  check_value(json, "depth", 1.551e-3, 0.032e-3, 1.5e-3);
  check_value(json, "thickness", 2.942e-3, 0.055e-3, 3.0e-3);
  CHECK(line_gains_left(json, "fe-rods") <= 0.022);
}

TEST_CASE("a calibrated scene keeps the file and finds itself again", "[cli][calibrate]") {
  const Folder folder;
  std::string toml = "# my pad\n" + read_text(nominal_of("rod-layer"));
  toml.insert(toml.find("\nreads"), "  # from the drawing");
  const std::string nominal = folder.write("pad.toml", toml);
  const ProcessResult first = run_tool(
      {"calibrate", log_of("rod-layer"), "--scene", nominal, "-o", folder / "calibrated.toml"});
  CAPTURE(first.output, first.errors);
  REQUIRE(first.code == 0);
  CHECK_THAT(first.output, ContainsSubstring("depth") && ContainsSubstring("identified") &&
                               ContainsSubstring("Young's modulus has no effect"));
  const std::string written = read_text(folder / "calibrated.toml");
  CHECK_THAT(written, StartsWith("# my pad\n") && ContainsSubstring("  # from the drawing") &&
                          ContainsSubstring("[calibration]") && ContainsSubstring("[noise]") &&
                          ContainsSubstring("youngs_modulus = 200000\n"));
  const Scene found = read_scene(folder / "calibrated.toml");
  CHECK(found.sensor.depths.front() > 1.5e-3);
  REQUIRE(found.calibration.has_value());

  // What is calibrated needs no calibration: the same log again moves nothing.
  const ProcessResult again = run_tool({"calibrate", log_of("rod-layer"), "--scene",
                                        folder / "calibrated.toml", "-o", folder / "again.toml"});
  REQUIRE(again.code == 0);
  const Scene second = read_scene(folder / "again.toml");
  CHECK_THAT(second.sensor.depths.front(), WithinRel(found.sensor.depths.front(), 0.01));
  for (std::size_t j = 3; j < 38; ++j)  // those at the ends are weak: what is stated counts twice
    CHECK_THAT(second.calibration->gain[j], WithinRel(found.calibration->gain[j], 0.02));
}

TEST_CASE("forces of presses that were not in the log are found better", "[cli][calibrate]") {
  // Every fourth press of the log is held out, and solved with both scenes.
  const std::string text = read_text(log_of("rod-layer"));
  std::string learnt, frames;
  std::vector<double> forces;
  std::size_t row = 0;
  for (std::size_t from = 0; from < text.size(); ++row) {
    const std::size_t end = text.find('\n', from);
    const std::string line = text.substr(from, end - from);
    std::size_t column = 0;
    for (int comma = 0; comma < 8; ++comma) column = line.find(',', column) + 1;
    if (row == 0) frames = line.substr(column) + '\n';
    if (row > 20 && row % 4 == 0) {
      frames += line.substr(column) + '\n';
      forces.push_back(std::stod(line.substr(line.find(',', line.find(',') + 1) + 1)));
    } else {
      learnt += line + '\n';
    }
    from = end + 1;
  }
  REQUIRE(forces.size() == 5);
  const Folder folder;
  const std::string readings = folder.write("held-out.csv", frames);
  REQUIRE(run_tool({"calibrate", folder.write("log.csv", learnt), "--scene",
                    nominal_of("rod-layer"), "-o", folder / "calibrated.toml"})
              .code == 0);
  const auto error = [&](const std::string& toml, const std::string& name) {
    const std::string file = folder / name;
    REQUIRE(run_tool({"solve", toml, "--readings", readings, "-q", "-o", folder / "f.csv",
                      "--uncertainty", file})
                .code == 0);
    std::istringstream rows(read_text(file));
    std::string line;
    std::getline(rows, line);
    REQUIRE_THAT(line, StartsWith("normal_force,"));
    double squares = 0.0;
    for (const double force : forces) {
      std::getline(rows, line);
      squares += std::pow(std::stod(line) / force - 1.0, 2) / 5.0;
    }
    return std::sqrt(squares);
  };
  const double nominal = error(nominal_of("rod-layer"), "nominal.csv");
  const double calibrated_error = error(folder / "calibrated.toml", "calibrated.csv");
  CAPTURE(nominal, calibrated_error);
  CHECK(calibrated_error < 0.75 * nominal);
  CHECK(calibrated_error < 0.05);
}

TEST_CASE("a bad log is refused with its line and its rule", "[cli][calibrate]") {
  struct Bad {
    std::size_t line;
    std::size_t field;
    std::string value;
    std::string says;
  };
  const Bad bad = GENERATE(values<Bad>({
      {22, 2, "-5", "log.csv:22: error: "},
      {22, 2, "-5", "force must be > 0 (got -5)"},
      {22, 3, "-1", "force_sd must be >= 0"},
      {22, 1, "ball", "shape 'ball' is not known"},
      {22, 4, "0.5", "position lies beyond the array"},
      {22, 7, "0.4", "wider than the array"},
      {22, 6, "-1", "radius must be > 0"},
      {22, 9, "nan", "stress_x_1 is not a finite number"},
      {22, 9, "", "stress_x_1 is not a finite number"},
      {23, 0, "1", "press 1 stands there twice"},
      {23, 0, "x", "press is not a whole number"},
      {1, 8, "stress_y_0", "has no column 'stress_x_0'"},
      {1, 2, "power", "has no column 'force'"},
      {2, 0, "99", "has only 19 unloaded rows"},
  }));
  const Folder folder;
  const std::string path = folder.write(
      "log.csv", edited_line("rod-layer", bad.line, [&](std::vector<std::string>& fields) {
        fields[bad.field] = bad.value;
        if (bad.says.find("19") != std::string::npos) fields[1] = "cylinder", fields[2] = "";
      }));
  const ProcessResult result =
      run_tool({"calibrate", path, "--scene", nominal_of("rod-layer"), "-o", folder / "c.toml"});
  CAPTURE(bad.line, bad.field, bad.value);
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, ContainsSubstring(bad.says));
  CHECK_FALSE(std::filesystem::exists(folder / "c.toml"));
}

TEST_CASE("a dead taxel costs a calibration its own reading alone", "[cli][calibrate][long]") {
  const Json whole = calibrated_with("rod-layer", nothing_stated);
  const std::string index = GENERATE("0", "20", "40");
  CAPTURE(index);
  const Json without =
      calibrated_with("rod-layer", nothing_stated + "[dead_taxels]\nindices = [" + index + "]\n");
  for (const char* parameter : {"depth", "thickness", "poisson_ratio"}) {
    CAPTURE(parameter);
    const Json& one = whole["parameters"][parameter];
    const Json& other = without["parameters"][parameter];
    CHECK(std::abs(one["value"].get<double>() - other["value"].get<double>()) <=
          one["sd"].get<double>());
    CHECK(one["verdict"] == other["verdict"]);
  }
  CHECK(without["null_directions"].size() == whole["null_directions"].size());
}

TEST_CASE("a calibration never replaces what it reads", "[cli][calibrate]") {
  const Folder folder;
  const std::string log = folder.write("log.csv", read_text(log_of("rod-layer")));
  const std::string nominal = folder.write("pad.toml", read_text(nominal_of("rod-layer")));
  std::filesystem::create_symlink(log, folder / "link.csv");
  using Options = std::vector<std::string>;
  for (const Options& outputs : {Options{"-o", log}, Options{"--json", folder / "./log.csv"},
                                 Options{"-o", nominal}, Options{"--json", folder / "link.csv"},
                                 Options{"-o", folder / "one", "--json", folder / "one"}}) {
    Options command{"calibrate", log, "--scene", nominal};
    command.insert(command.end(), outputs.begin(), outputs.end());
    CAPTURE(outputs[0], outputs[1]);
    const ProcessResult result = run_tool(command);
    CHECK(result.code == 2);
    CHECK_THAT(result.errors,
               ContainsSubstring(outputs.size() > 2 ? "need one each" : "that is read"));
  }
  CHECK(read_text(log) == read_text(log_of("rod-layer")));
  CHECK(read_text(nominal) == read_text(nominal_of("rod-layer")));
}

TEST_CASE("a width beyond all reason takes no memory beyond it", "[cli][calibrate][long]") {
  const Folder folder;
  const std::string log = folder.write(
      "log.csv",
      edited_line("strain-rods", 30, [](std::vector<std::string>& fields) { fields[6] = "1e9"; }));
  const ProcessResult result = run_tool({"calibrate", log, "--scene", nominal_of("strain-rods")});
  CAPTURE(result.output, result.errors);
  CHECK(result.code == 1);
}

TEST_CASE("a log of another scene names the readings that it lacks", "[cli][calibrate]") {
  const ProcessResult result =
      run_tool({"calibrate", log_of("rod-layer"), "--scene", nominal_of("strain-rods")});
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, ContainsSubstring("strain_x_0") && ContainsSubstring("another scene"));
}

TEST_CASE("the next presses buy more with every one", "[cli][calibrate]") {
  const Json json = calibrated_with("one-place", "", {"--next", "4"});
  double before = json["unknown_now"];
  REQUIRE(json["next"].size() == 4);
  for (const Json& press : json["next"]) {
    CHECK(press["unknown_then"].get<double>() < before);
    before = press["unknown_then"];
  }
  // All presses were in the middle: what is unknown lies outside.
  CHECK(std::abs(json["next"][0]["position"].get<double>()) > 2e-3);
}

TEST_CASE("a calibration's page has its figures", "[cli][calibrate]") {
  const Folder folder;
  const ProcessResult result = run_tool({"calibrate", log_of("rod-layer"), "--scene",
                                         nominal_of("rod-layer"), "--out", folder / "out"});
  REQUIRE(result.code == 0);
  const std::string page = read_text(folder / "out/report.html");
  CHECK_THAT(page, ContainsSubstring("What this log cannot tell") && ContainsSubstring("Gains") &&
                       ContainsSubstring("profile"));
}
