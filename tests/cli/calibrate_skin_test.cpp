// Skins calibrated by the command: the shipped logs and their truth, what the calibrated scene does
// to contacts that were not in the log, and logs that are wrong.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/cli/calibration_logs.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Json = nlohmann::json;

/// What calibrate says, and the scene that it writes into the folder.
Json calibrated_skin(const Folder& folder, const std::string& log, const std::string& nominal,
                     std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"calibrate", log, "--scene", nominal, "-o",
                                   folder / "calibrated.toml", "--json", folder / "found.json"});
  const ProcessResult result = run_tool(options);
  CAPTURE(result.output, result.errors);
  REQUIRE(result.code == 0);
  return Json::parse(read_text(folder / "found.json"));
}

void check_near(const Json& json, const std::string& parameter, double truth, double most_sd) {
  const Json& one = json["parameters"][parameter];
  CAPTURE(parameter, one.dump(), truth);
  CHECK(std::abs(one["value"].get<double>() - truth) <= 3.0 * one["sd"].get<double>());
  CHECK(one["sd"].get<double>() <= most_sd);
}

/// A line of a log with one field changed, both counted from 1.
std::string with_field(const std::string& text, std::size_t line, std::size_t field,
                       const std::string& with) {
  std::size_t at = 0;
  for (std::size_t i = 1; i < line; ++i) at = text.find('\n', at) + 1;
  for (std::size_t i = 1; i < field; ++i) at = text.find(',', at) + 1;
  return text.substr(0, at) + with + text.substr(text.find(',', at));
}

}  // namespace

TEST_CASE("a skin's depth and gains are found from balls on a half space", "[cli][calibrate]") {
  const Folder folder;
  const Json truth = truth_of("skin-balls");
  const Json json = calibrated_skin(folder, log_of("skin-balls"), nominal_of("skin-balls"));
  CHECK(json["fit"]["verdict"] == "ok");
  check_near(json, "depth", truth["truth"]["depth"], 0.02e-3);
  CHECK(std::abs(json["fit"]["rms"].get<double>() - 1.0) < 0.05);
  CHECK(gains_left(json, truth["gains"]) < 0.03);
  // Balls tell E / (1 - nu^2) alone, and E as well as nu is stated.
  check_near(json, "youngs_modulus", truth["truth"]["E"], 0.02e6);
  CHECK(json["parameters"]["poisson_ratio"]["verdict"] == "prior_only");
  CHECK(json["null_directions"].size() == 1);
  for (std::size_t p = 0; p < json["presses"].size(); ++p) {
    const Json& press = json["presses"][p];
    const Json& one = truth["presses"][p];
    const auto off = [&](const char* key, double value) {
      return std::abs(press[key]["value"].get<double>() - value) / press[key]["sd"].get<double>();
    };
    CHECK(off("centre", one["y"].get<double>() * 1e-3) < 4.5);
    CHECK(off("centre_z", one["z"].get<double>() * 1e-3) < 4.5);
    CHECK(off("force", one["F"].get<double>()) < 4.5);
  }
}

TEST_CASE("a skin's layer is found from contacts of known width", "[cli][calibrate]") {
  const Folder folder;
  const Json truth = truth_of("skin-layer");
  const Json json = calibrated_skin(folder, log_of("skin-layer"), nominal_of("skin-layer"));
  CHECK(json["fit"]["verdict"] == "ok");
  check_near(json, "depth", truth["truth"]["depth"], 0.05e-3);
  check_near(json, "thickness", truth["truth"]["thickness"], 0.3e-3);
  CHECK(std::abs(json["fit"]["rms"].get<double>() - 1.0) < 0.06);
  CHECK(json["parameters"]["youngs_modulus"]["verdict"] == "not_identifiable");
  // Comments stay, and what was found stands in place of what was stated.
  const std::string text = read_text(folder / "calibrated.toml");
  CHECK(text.substr(0, 20) == read_text(nominal_of("skin-layer")).substr(0, 20));
  const auto written = std::get<SkinScene>(read_any_scene(folder / "calibrated.toml"));
  CHECK_THAT(written.sensor.depths.front(),
             WithinRel(json["parameters"]["depth"]["value"].get<double>(), 1e-4));
  CHECK(written.material.youngs_modulus == 0.25e6);
  CHECK(written.calibration);
}

TEST_CASE("a calibrated skin finds contacts that were not in the log better",
          "[cli][calibrate][long]") {
  const Folder folder;
  const Json truth = truth_of("skin-balls");
  static_cast<void>(calibrated_skin(folder, log_of("skin-balls"), nominal_of("skin-balls")));
  const std::string calibrated_scene = read_text(folder / "calibrated.toml");
  const std::string nominal = read_text(nominal_of("skin-balls"));
  // The true sensor under contacts of its own: the exact readings, its gains, offsets, noise.
  std::string sensor = replaced(nominal, "depth = 1.6", "depth = 1.9");
  sensor = replaced(sensor, "youngs_modulus = 0.2", "youngs_modulus = 0.26");
  std::mt19937_64 random(77);
  std::normal_distribution<double> normal;
  std::string recording;
  std::string tared;
  std::vector<double> forces;
  for (int i = 0; i < 6; ++i) {
    forces.push_back(0.4 + 0.1 * i);
    const std::string toml = sensor + "\n[[contact]]\nshape = \"sphere\"\nplace = [" +
                             shortest(-4.0 + 1.7 * i) + ", " + shortest(3.0 - 1.3 * i) +
                             "]\nradius = " + shortest(1.5 + 0.2 * i) +
                             "\nforce = " + shortest(forces.back()) + '\n';
    const ProcessResult made = run_tool({"simulate", folder.write("truth.toml", toml)});
    REQUIRE(made.code == 0);
    const std::vector<std::string> lines = lines_of(made.output);
    if (recording.empty()) recording = tared = lines[0] + '\n';
    std::size_t j = 0;
    std::string raw, zeroed;
    for (std::size_t from = 0; from < lines[1].size(); ++j) {
      const std::size_t end = std::min(lines[1].find(',', from), lines[1].size());
      const double clean = std::stod(lines[1].substr(from, end - from));
      const double rms = truth["noise_rms"][truth["quantities"][j / 64].get<std::string>()];
      const double above = truth["gains"][j].get<double>() * clean + rms * normal(random);
      raw += (j > 0 ? "," : "") + shortest(above + truth["offsets"][j].get<double>());
      zeroed += (j > 0 ? "," : "") + shortest(above);
      from = end + 1;
    }
    recording += raw + '\n';
    tared += zeroed + '\n';
  }
  const auto error = [&](const std::string& toml, const std::string& readings) {
    const ProcessResult solved = run_tool(
        {"solve", folder.write("pad.toml", toml + "\n[reconstruct]\nnonnegative = true\n"),
         "--readings", folder.write("readings.csv", readings), "--json", folder / "solved.json"});
    CAPTURE(solved.errors);
    REQUIRE(solved.code == 0);
    const Json json = Json::parse(read_text(folder / "solved.json"));
    double squares = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i)
      squares +=
          std::pow(json["rows"][i]["resultant"]["normal"]["value"].get<double>() / forces[i] - 1.0,
                   2) /
          static_cast<double>(forces.size());
    return std::sqrt(squares);
  };
  // The nominal scene is spared the offsets.
  std::string noise;
  for (const auto& [quantity, rms] : truth["noise_rms"].items())
    noise += (noise.empty() ? "" : ", ") + quantity + " = " + rms.dump();
  const double before = error(nominal + "\n[noise]\nrms = { " + noise + " }\n", tared);
  const double after = error(calibrated_scene, recording);
  CAPTURE(before, after);
  CHECK(after < 0.7 * before);
  CHECK(after < 0.04);
}

TEST_CASE("taxels of a file get a factor on their depths", "[cli][calibrate]") {
  const Folder folder;
  const std::string text = read_text(log_of("skin-layer"));
  // The same skin as taxels of a file: columns are called by the taxels' names.
  std::string taxels = "name,y,z,depth\n";
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column)
      taxels += std::to_string(row) + '_' + std::to_string(column) + ',' +
                shortest(1.8 * (row - 2.5)) + ',' + shortest(1.8 * (column - 2.5)) + ",1.4\n";
  folder.write("taxels.csv", taxels);
  std::string toml = read_text(nominal_of("skin-layer"));
  toml =
      replaced(toml, "rows = 6\ncolumns = 6\npitch = 1.8\ndepth = 1.4", "taxels = \"taxels.csv\"");
  const Json json =
      calibrated_skin(folder, folder.write("log.csv", text), folder.write("nominal.toml", toml));
  const Json even = calibrated_skin(Folder(), log_of("skin-layer"), nominal_of("skin-layer"));
  const double depth = json["parameters"]["depth"]["value"];
  CHECK_THAT(depth, WithinRel(even["parameters"]["depth"]["value"].get<double>(), 1e-6));
  const auto written = std::get<SkinScene>(read_any_scene(folder / "calibrated.toml"));
  CHECK_THAT(written.sensor.depths.front(), WithinRel(depth, 1e-4));
}

TEST_CASE("a log of a skin that is wrong is refused with its line and the rule",
          "[cli][calibrate]") {
  const Folder folder;
  const std::string text = read_text(log_of("skin-layer"));
  const auto errors = [&](const std::string& log, const std::string& table = "") {
    const ProcessResult result =
        run_tool({"calibrate", folder.write("log.csv", log), "--scene",
                  folder.write("pad.toml", read_text(nominal_of("skin-layer")) + table), "-o",
                  folder / "out.toml"});
    CHECK(result.code == 2);
    return result.errors;
  };
  CHECK_THAT(errors(with_field(text, 22, 2, "cylinder")),
             ContainsSubstring("log.csv:22") && ContainsSubstring("sphere, punch, cone"));
  CHECK_THAT(errors(with_field(text, 22, 3, "-1")), ContainsSubstring("force must be > 0"));
  CHECK_THAT(errors(with_field(text, 23, 6, "60")),
             ContainsSubstring("position_z lies beyond the array"));
  CHECK_THAT(errors(with_field(text, 23, 8, "4")), ContainsSubstring("radius is of a sphere"));
  CHECK_THAT(errors(replaced(text, "position_y", "position")),
             ContainsSubstring("has no column 'position_y'"));
  CHECK_THAT(errors(replaced(text, "stress_x_0_0,", "stress_x_9_9,")),
             ContainsSubstring("has no column 'stress_x_0_0'"));
  // Columns that were swapped: places are seen along the other axis.
  CHECK_THAT(errors(replaced(
                 replaced(replaced(text, "position_y", "position_q"), "position_z", "position_y"),
                 "position_q", "position_z")),
             ContainsSubstring("swapped"));
  // A drag without its direction, a direction without a drag, and one that pushes back.
  const auto dragged = [&](const std::string& friction, const std::string& direction) {
    const std::vector<std::string> rows = lines_of(text);
    std::string log = rows.front() + ",friction,direction\n";
    for (std::size_t row = 1; row < rows.size(); ++row)
      log += rows[row] + (row == 21 ? ',' + friction + ',' + direction : ",,") + '\n';
    return errors(log);
  };
  CHECK_THAT(dragged("0.3", ""),
             ContainsSubstring("log.csv:22") && ContainsSubstring("without its direction"));
  CHECK_THAT(dragged("", "90"), ContainsSubstring("direction is given without friction"));
  CHECK_THAT(dragged("-0.3", "90"), ContainsSubstring("friction must be >= 0"));
  const ProcessResult planned = run_tool(
      {"calibrate", log_of("skin-layer"), "--scene", nominal_of("skin-layer"), "--next", "0"});
  CHECK(planned.code == 2);
  CHECK_THAT(planned.errors, ContainsSubstring("plans 1 to 100 presses"));
}

TEST_CASE("a skin's next presses buy more with every one, in words and JSON", "[cli][calibrate]") {
  const Folder folder;
  const auto planned = [&](const std::string& json) {
    return run_tool({"calibrate", log_of("skin-layer"), "--scene", nominal_of("skin-layer"),
                     "--next", "3", "--target", "depth", "--json", folder / json, "--out",
                     folder / "page"});
  };
  const ProcessResult result = planned("found.json");
  REQUIRE(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("contact radius") &&
                                ContainsSubstring("of the depth is unknown") &&
                                ContainsSubstring("Press straight down"));
  CHECK_THAT(read_text(folder / "page/report.html"), ContainsSubstring("Presses to do next"));
  const Json json = Json::parse(read_text(folder / "found.json"));
  REQUIRE(json["next"].size() == 3);
  double unknown = json["unknown_now"];
  const Json& depth = json["parameters"]["depth"];
  CHECK_THAT(unknown, WithinRel(depth["sd"].get<double>() / depth["value"].get<double>(), 0.1));
  for (const Json& press : json["next"]) {
    CHECK(press["unknown_then"].get<double>() < unknown);
    unknown = press["unknown_then"];
    CHECK(std::abs(press["position"].get<double>()) < 4.5e-3);
    CHECK(std::abs(press["position_z"].get<double>()) < 4.5e-3);
    CHECK(press["radius"].is_null() == (press["shape"] != "sphere"));
  }
  REQUIRE(planned("again.json").code == 0);
  CHECK(read_text(folder / "again.json") == read_text(folder / "found.json"));
}

TEST_CASE("a skin that lies elsewhere on its stage is found there, or said to be hidden",
          "[cli][calibrate][long]") {
  const Folder folder;
  const std::string scene_text =
      read_text(nominal_of("skin-balls")) + "\n[calibrate]\nshift_sd = 1.0\n";
  const std::string nominal = folder.write("nominal.toml", scene_text);
  // Every position 0.5 mm larger along z: the skin lies there.
  const std::vector<std::string> rows = lines_of(read_text(log_of("skin-balls")));
  std::string moved = rows.front() + '\n';
  std::string nowhere = moved;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    std::string row = rows[i];
    std::vector<std::size_t> commas;
    for (std::size_t k = 0; k < row.size() && commas.size() < 7; ++k)
      if (row[k] == ',') commas.push_back(k);
    const std::string z = row.substr(commas[4] + 1, commas[5] - commas[4] - 1);
    moved += (z.empty() ? row
                        : row.substr(0, commas[4] + 1) + shortest(std::stod(z) + 0.5) +
                              row.substr(commas[5])) +
             '\n';
    nowhere += row.substr(0, commas[3] + 1) + ",," + row.substr(commas[6]) + '\n';
  }
  const Json found = calibrated_skin(folder, folder.write("moved.csv", moved), nominal);
  check_near(found, "shift", 0.0, 1e-4);
  check_near(found, "shift_z", 0.5e-3, 1e-4);
  CHECK_THAT(read_text(folder / "calibrated.toml"), ContainsSubstring("shift_z = "));
  const ProcessResult hidden =
      run_tool({"calibrate", folder.write("nowhere.csv", nowhere), "--scene", nominal});
  CHECK(hidden.code == 0);
  CHECK_THAT(hidden.output,
             ContainsSubstring("The shift of the skin along y has no effect on these readings: "
                               "no position is stated.") &&
                 ContainsSubstring("The shift of the skin along z has no effect"));
}

TEST_CASE("a drag that the log states is fitted with it, one that it hides is named",
          "[cli][calibrate][long]") {
  const Folder folder;
  const Json truth = truth_of("skin-balls");
  // One more press of the true sensor, dragged towards z, as simulate has it.
  std::string sensor = read_text(nominal_of("skin-balls"));
  sensor = replaced(sensor, "depth = 1.6", "depth = 1.9");
  sensor = replaced(sensor, "youngs_modulus = 0.2", "youngs_modulus = 0.26");
  sensor = replaced(sensor, "poisson_ratio = 0.48", "poisson_ratio = 0.46");
  const ProcessResult made = run_tool(
      {"simulate", folder.write("truth.toml", sensor + "\n[[contact]]\nshape = \"sphere\"\nplace = "
                                                       "[1.0, -2.0]\nradius = 1.8\nforce = 1.0\n"
                                                       "friction = 0.4\ndirection = 90\n")});
  REQUIRE(made.code == 0);
  const std::vector<std::string> rows = lines_of(read_text(log_of("skin-balls")));
  const auto log_with = [&](const std::string& friction) {
    std::string log = rows.front() + ",friction,direction,friction_sd\n";
    for (std::size_t i = 1; i < rows.size(); ++i) log += rows[i] + ",,,\n";
    log += "99,sphere,1.0,,1.0,-2.0,,,1.8";
    const std::string clean = lines_of(made.output)[1];
    std::size_t j = 0;
    for (std::size_t from = 0; from < clean.size(); ++j) {
      const std::size_t end = std::min(clean.find(',', from), clean.size());
      log += ',' +
             shortest(truth["gains"][j].get<double>() * std::stod(clean.substr(from, end - from)) +
                      truth["offsets"][j].get<double>());
      from = end + 1;
    }
    return folder.write("log.csv", log + ',' + friction + '\n');
  };
  for (const std::string friction : {"0.4,90,0.05", "0,,0.5"}) {
    const Json found = calibrated_skin(folder, log_with(friction), nominal_of("skin-balls"));
    const Json& press = found["presses"].back();
    CAPTURE(friction, press.dump());
    CHECK(std::abs(press["friction"]["value"].get<double>()) < 0.03);
    CHECK_THAT(press["friction_z"]["value"].get<double>(), WithinAbs(0.4, 0.03));
  }
  const ProcessResult straight =
      run_tool({"calibrate", log_with(",,"), "--scene", nominal_of("skin-balls"), "--robust"});
  CHECK_THAT(straight.output, ContainsSubstring("Press 99 does not fit its stated friction z"));
}

TEST_CASE("a skin of finite elements is calibrated within its standard deviations",
          "[cli][calibrate]") {
  // One round contact of scenes/recorded/skin-pad.csv, of a known radius; its spin has no effect
  // on stress_x. Each of 25 windows of 9 x 9 taxels is a press at another place.
  constexpr std::size_t all = 17, side = 9;
  constexpr double force = 0.32724923474893486, y = -0.7, z = 0.5;
  std::istringstream text(read_text(scene("recorded/skin-pad.csv")));
  std::string line;
  for (int row = 0; row < 5; ++row) std::getline(text, line);
  std::istringstream fields(line);
  std::vector<double> readings;
  for (std::string field; readings.size() < all * all && std::getline(fields, field, ',');)
    readings.push_back(std::stod(field));
  REQUIRE(readings.size() == all * all);

  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> gains(side * side);
  for (double& gain : gains) gain = std::exp(0.05 * normal(random));
  std::string log =
      "press,shape,force,force_sd,position_y,position_z,position_sd,radius,half_width";
  for (std::size_t i = 0; i < side; ++i)
    for (std::size_t j = 0; j < side; ++j)
      log += ",stress_x_" + std::to_string(i) + '_' + std::to_string(j);
  for (int rest = 0; rest < 24; ++rest) {
    log += "\n0,none,,,,,,,";
    for (std::size_t k = 0; k < gains.size(); ++k) log += ',' + shortest(39.7 * normal(random));
  }
  int press = 0;
  for (std::size_t a = 0; a <= all - side; a += 2)
    for (std::size_t b = 0; b <= all - side; b += 2) {
      const auto stated = [&](double place, std::size_t window) {
        return ',' + shortest(place - (static_cast<double>(window) - 4.0) + 0.05 * normal(random));
      };
      log += '\n' + std::to_string(++press) + ",sphere," +
             shortest(force * (1.0 + 0.01 * normal(random))) + ',' + shortest(0.01 * force) +
             stated(y, a) + stated(z, b) + ",0.05,,2.5";
      for (std::size_t i = 0; i < side; ++i)
        for (std::size_t j = 0; j < side; ++j)
          log += ',' + shortest(gains[i * side + j] * readings[(a + i) * all + b + j]);
    }
  const std::string nominal =
      "[units]\nlength = \"mm\"\nmodulus = \"MPa\"\nstress = \"Pa\"\nforce = \"N\"\n[sensor]\n"
      "rows = 9\ncolumns = 9\npitch = 1.0\ndepth = 1.7\nreads = [\"stress_x\"]\n[material]\n"
      "youngs_modulus = 0.25\npoisson_ratio = 0.46\n"
      "layer = { thickness = 4.5, base = \"bonded\" }\n";
  const Folder folder;
  const Json json =
      calibrated_skin(folder, folder.write("log.csv", log), folder.write("pad.toml", nominal));
  check_near(json, "depth", 2e-3, 0.02e-3);
  check_near(json, "thickness", 4e-3, 0.05e-3);
  check_near(json, "poisson_ratio", 0.48, 0.01);
  CHECK(json["fit"]["rms"].get<double>() < 1.1);
  CHECK(json["other_base_gain"].get<double>() < 0.0);
  CHECK(gains_left(json, gains) < 0.01);
}
