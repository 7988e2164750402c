#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/lab/calibrate.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/pages/calibration_page.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/calibration/simulated_log.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Json = nlohmann::json;
using Row = std::vector<std::string>;

std::string nominal() { return scene("calibration/rod-layer.toml"); }

constexpr std::size_t first_reading = 8;  // column; 20 unloaded rows, then 20 presses

/// The public log with its rows edited; row 0 is the header.
std::string edited_log(const std::function<void(std::size_t, Row&)>& edit) {
  std::istringstream text(read_text(scene("calibration/rod-layer.csv")));
  std::string result;
  std::string line;
  for (std::size_t number = 0; std::getline(text, line); ++number) {
    Row row(1);
    for (const char c : line) {
      if (c == ',')
        row.emplace_back();
      else
        row.back() += c;
    }
    edit(number, row);
    for (std::size_t i = 0; i < row.size(); ++i) result += (i > 0 ? "," : "") + row[i];
    result += '\n';
  }
  return result;
}

struct Ran {
  ProcessResult result;
  bool wrote;
};

/// The command on a log, with the scene beside it.
Ran calibrate_log(const std::string& log, std::vector<std::string> options = {},
                  const std::string& toml = read_text(nominal())) {
  const Folder folder;
  options.insert(options.begin(), {"calibrate", folder.write("log.csv", log), "--scene",
                                   folder.write("pad.toml", toml), "-o", folder / "c.toml"});
  const ProcessResult result = run_tool(options);
  return {result, std::filesystem::exists(folder / "c.toml")};
}

}  // namespace

TEST_CASE("what no calibration mends is refused with its reason", "[cli][calibrate]") {
  struct Bad {
    std::function<void(std::size_t, Row&)> edit;
    std::string says;
  };
  const auto readings = [](const std::function<double(double)>& change) {
    return [change](std::size_t line, Row& row) {
      for (std::size_t i = first_reading; line > 0 && i < row.size(); ++i)
        row[i] = shortest(change(std::stod(row[i])));
    };
  };
  const std::vector<Bad> all = {
      {readings([](double x) { return -x; }), "the other sign"},
      {[](std::size_t line, Row& row) {
         if (line > 20) row[2] = shortest(1e-3 * std::stod(row[2]));
       },
       "units of the forces"},
      {[](std::size_t line, Row& row) {
         if (line == 5) row[1] = "cylinder";
       },
       "log.csv:6: error: press 0 is a row without load"},
      {[](std::size_t line, Row& row) {
         if (line == 5) row[2] = "300";
       },
       "log.csv:6: error: is a row without load, and has a force"},
      {[](std::size_t line, Row& row) {
         if (line != 5) return;
         for (std::size_t i = first_reading + 15; i < first_reading + 26; ++i)
           row[i] = shortest(std::stod(row[i]) + 20000.0);
       },
       "log.csv:6: error: is not a row without load"},
      {[](std::size_t line, Row& row) { row.push_back(line == 0 ? "stress_x_41" : "1.5"); },
       "has 42 columns stress_x_0, ..., and the scene has 41 taxels"},
      {[](std::size_t line, Row& row) {
         if (line > 0) row[first_reading + 9] = "512";
       },
       "stress_x_9 never changes: a dead taxel"},
  };
  for (const Bad& bad : all) {
    CAPTURE(bad.says);
    const Ran ran = calibrate_log(edited_log(bad.edit));
    CHECK(ran.result.code == 2);
    CHECK_THAT(ran.result.errors, ContainsSubstring(bad.says));
    CHECK_FALSE(ran.wrote);
  }
}

TEST_CASE("a converter with coarse steps is not taken for a range that ends", "[cli][calibrate]") {
  double most = 0.0;
  edited_log([&](std::size_t line, Row& row) {
    for (std::size_t i = first_reading; line > 20 && i < row.size(); ++i)
      most = std::max(most, std::abs(std::stod(row[i])));
    return;
  });
  const double step = most / 127.0;  // 8 bits, with the sign
  const auto coarse = [&](double range) {
    return edited_log([&](std::size_t line, Row& row) {
      for (std::size_t i = first_reading; line > 0 && i < row.size(); ++i)
        row[i] = shortest(std::clamp(step * std::round(std::stod(row[i]) / step), -range, range));
    });
  };
  const Ran open = calibrate_log(coarse(2.0 * most));
  CAPTURE(open.result.output, open.result.errors);
  CHECK(open.result.code == 0);
  const Ran cut = calibrate_log(coarse(0.4 * most));
  CAPTURE(cut.result.errors);
  CHECK(cut.result.code == 2);
  CHECK_THAT(cut.result.errors, ContainsSubstring("cut off at the end of its range"));
}

TEST_CASE("a force's fit that failed and was written says so everywhere", "[cli][calibrate]") {
  const std::string log = edited_log([](std::size_t line, Row& row) {
    if (line > 20) row[first_reading + 20] = "0";
  });
  const Folder folder;
  const std::vector<std::string> command = {
      "calibrate", folder.write("log.csv", log),
      "--scene",   folder.write("pad.toml", read_text(nominal())),
      "-o",        folder / "c.toml",
      "--out",     folder / "out"};
  const ProcessResult without = run_tool(command);
  CAPTURE(without.output, without.errors);
  CHECK(without.code == 1);
  CHECK_THAT(without.output, ContainsSubstring("nothing is written without --force") &&
                                 ContainsSubstring("List taxel 20 in [dead_taxels]"));
  CHECK_FALSE(std::filesystem::exists(folder / "c.toml"));
  CHECK_FALSE(Json::parse(read_text(folder / "out/result.json"))["fit"]["forced"].get<bool>());

  std::vector<std::string> forced = command;
  forced.emplace_back("--force");
  const ProcessResult with = run_tool(forced);
  CHECK(with.code == 1);
  CHECK_THAT(with.output, ContainsSubstring("written all the same, by --force") &&
                              !ContainsSubstring("nothing is written"));
  CHECK_THAT(with.errors, ContainsSubstring("written by --force"));
  CHECK_THAT(read_text(folder / "c.toml"), ContainsSubstring("# poor_fit: not to be trusted"));
  CHECK_THAT(read_text(folder / "out/report.html"), ContainsSubstring("by --force"));
  CHECK(Json::parse(read_text(folder / "out/result.json"))["fit"]["forced"].get<bool>());
}

TEST_CASE("JSON has the gains and offsets of the calibrated scene", "[cli][calibrate]") {
  const Folder folder;
  const std::string log = scene("calibration/rod-layer.csv");
  REQUIRE(run_tool({"calibrate", log, "--scene", nominal(), "-o", folder / "one.toml"}).code == 0);
  // The calibrated scene is the nominal one of the next: what it states is not lost.
  REQUIRE(run_tool({"calibrate", log, "--scene", folder / "one.toml", "-o", folder / "two.toml",
                    "--json", folder / "two.json"})
              .code == 0);
  const Json json = Json::parse(read_text(folder / "two.json"));
  const Scene written = read_scene(folder / "two.toml");
  REQUIRE(written.calibration.has_value());
  for (std::size_t j = 0; j < 41; ++j) {
    CAPTURE(j);
    CHECK_THAT(json["gains"][j]["value"].get<double>(),
               WithinRel(1.0 / written.calibration->gain[j], 1e-4));
    const double sd = json["offsets"][j]["sd"];
    CHECK_THAT(json["offsets"][j]["value"].get<double>(),
               WithinAbs(written.calibration->baseline[j], 1e-2 * sd));
  }
}

TEST_CASE("a scene with the line ends of Windows keeps them", "[cli][calibrate]") {
  std::string toml;
  for (const char c : read_text(nominal())) toml += c == '\n' ? "\r\n" : std::string(1, c);
  const Folder folder;
  REQUIRE(run_tool({"calibrate", scene("calibration/rod-layer.csv"), "--scene",
                    folder.write("pad.toml", toml), "-o", folder / "c.toml"})
              .code == 0);
  const std::string written = read_text(folder / "c.toml");
  CHECK_THAT(written, ContainsSubstring("[calibration]"));
  for (std::size_t at = 0; (at = written.find('\n', at)) != std::string::npos; ++at) {
    REQUIRE(at > 0);
    CHECK(written[at - 1] == '\r');
  }
}

TEST_CASE("the scene's crosstalk moves the depth that is found", "[cli][calibrate]") {
  const Folder folder;
  const auto depth = [&](const std::string& more) {
    const ProcessResult result =
        run_tool({"calibrate", scene("calibration/rod-layer.csv"), "--scene",
                  folder.write("pad.toml", read_text(nominal()) + more), "--json", "-"});
    REQUIRE(result.code == 0);
    return Json::parse(result.output)["parameters"]["depth"]["value"].get<double>();
  };
  CHECK(depth("\n[crosstalk]\nfraction = 0.05\n") < depth("") - 1e-5);
}

TEST_CASE("forces that are all twice too large are remarked", "[cli][calibrate]") {
  const auto with_forces = [](double factor) {
    return calibrate_log(edited_log([&](std::size_t line, Row& row) {
             if (line <= 20) return;
             for (const std::size_t column : {2U, 3U})
               row[column] = shortest(factor * std::stod(row[column]));
           }))
        .result;
  };
  const ProcessResult sound = with_forces(1.0);
  CHECK(sound.code == 0);
  CHECK_THAT(sound.output, !ContainsSubstring("stated standard deviations from"));
  const ProcessResult doubled = with_forces(2.0);
  CHECK_THAT(doubled.output, ContainsSubstring("The mean gain of stress_x is 0.49") &&
                                 ContainsSubstring("stated standard deviations from 1"));
}

TEST_CASE("forces less sure than stated are told from sound ones", "[cli][calibrate]") {
  // No press alone is 5 deviations off: 4 % up and down in turn, 1 % is stated.
  const Ran ran = calibrate_log(edited_log([](std::size_t line, Row& row) {
    if (line > 20) row[2] = shortest((line % 2 == 0 ? 1.04 : 0.96) * std::stod(row[2]));
  }));
  CAPTURE(ran.result.output);
  CHECK(ran.result.code == 1);
  CHECK_FALSE(ran.wrote);
  CHECK_THAT(ran.result.output, ContainsSubstring("The stated forces are ") &&
                                    ContainsSubstring("times less certain than stated") &&
                                    !ContainsSubstring("The stated positions"));
}

TEST_CASE("a base that explains the presses better, or as well, is named", "[cli][calibrate]") {
  // Depth and thickness make up for it: the residuals' rms hardly tells.
  const auto words = [](const std::string& name, const std::string& base) {
    std::string toml = read_text(scene("calibration/" + name + ".toml"));
    toml.replace(toml.find("\"bonded\""), 8, '"' + base + '"');
    const Folder folder;
    return run_tool({"calibrate", scene("calibration/" + name + ".csv"), "--scene",
                     folder.write("pad.toml", toml)})
        .output;
  };
  const std::string better = "A bonded base explains these presses better than a slipping one";
  CHECK_THAT(words("no-loads", "frictionless"), ContainsSubstring(better));
  CHECK_THAT(words("no-loads", "bonded"), !ContainsSubstring("base explains these presses"));
  CHECK_THAT(words("rod-layer", "bonded"),
             ContainsSubstring("A slipping base explains these presses as well as a bonded one"));
}

TEST_CASE("a log of a spreadsheet that writes decimal commas is read alike", "[cli][calibrate]") {
  const std::string points = edited_log([](std::size_t, Row&) {});
  const std::string separator = GENERATE(";", "\t");
  std::string commas;
  for (const char c : points) commas += c == ',' ? separator : c == '.' ? "," : std::string(1, c);
  const Ran ran = calibrate_log(commas);
  CAPTURE(ran.result.errors);
  CHECK(ran.result.code == 0);
  CHECK(ran.result.output.substr(0, 600) == calibrate_log(points).result.output.substr(0, 600));
  // A point for thousands is no decimal point.
  const Ran thousands = calibrate_log(edited_log([](std::size_t line, Row& row) {
    for (std::string& field : row) field += ';';
    if (line == 22) row[2] = "1.234,5;";
  }));
  CHECK(thousands.result.code == 2);
}

TEST_CASE("a press beside the last taxel is no mistake, one far from it is", "[cli][calibrate]") {
  // The array ends at 10 mm, taxels are taken to be 1.4 mm deep; no width is stated.
  const auto at = [](const char* position) {
    return calibrate_log(edited_log([&](std::size_t line, Row& row) {
             if (line == 25) row[4] = position;
           }))
        .result.errors;
  };
  CHECK_THAT(at("0.0113"), !ContainsSubstring("beyond the array"));
  CHECK_THAT(at("0.0118"), ContainsSubstring("log.csv:26: error: position lies beyond the array"));
}

TEST_CASE("a page of two quantities shows both", "[cli][calibrate]") {
  const SimulatedLog made = simulated_log(3, {.reads = {Quantity::stress_x, Quantity::shear_xy}});
  Scene pad;
  pad.sensor = made.array;
  pad.sensor.depths = {made.nominal_depth};
  pad.material = made.nominal;
  const lab::SceneCalibration found = lab::calibrate(pad, made.log, {});
  CHECK_THAT(
      pages::calibration_html(found, "log.csv", {}).html,
      ContainsSubstring("worst-press-stress_x") && ContainsSubstring("worst-press-shear_xy"));
}
