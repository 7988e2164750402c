// Logs that the command itself has simulated: what calibrate finds is what made them, and what it
// writes run, solve and plan go on with; of uneven arrays, too.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
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

/// The lines that `simulate` writes of a scene, without their times.
std::vector<std::string> simulated(const Folder& folder, const std::string& toml) {
  const ProcessResult result = run_tool({"simulate", folder.write("simulated.toml", toml)});
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  std::vector<std::string> lines = lines_of(result.output);
  for (std::string& line : lines) line.erase(0, line.find(',') + 1);
  return lines;
}

const std::string log_header = "press,shape,force,force_sd,position,position_sd,radius,half_width,";

struct Rod {
  double force, centre, half_width;  // in the scene's units
};

std::vector<Rod> rods(double first, double last, double narrow) {
  std::vector<Rod> all;
  constexpr int count = 20;
  for (int i = 0; i < count; ++i)
    all.push_back({i % 3 == 0 ? 200.0 : 400.0, first + (last - first) * i / (count - 1),
                   i % 2 == 0 ? narrow : 2.2 * narrow});
  return all;
}

/// A log as somebody writes it down who has this sensor, which nothing presses as yet: 20 frames
/// at rest and a row for each rod.
std::string log_of_rods(const Folder& folder, const std::string& sensor,
                        const std::vector<Rod>& rods) {
  const auto at = [&](unsigned seed, std::size_t frames, const std::string& contact) {
    std::string toml = sensor;
    toml.insert(toml.find("rms"), "seed = " + std::to_string(seed) + "\n");
    return simulated(
        folder, toml + "\n[time]\nrate = 100\nframes = " + std::to_string(frames) + '\n' + contact);
  };
  const std::vector<std::string> rest = at(1000, 20, "");
  std::string log = log_header + rest[0] + '\n';
  for (std::size_t i = 1; i < rest.size(); ++i) log += "0,none,,,,,,," + rest[i] + '\n';
  for (std::size_t p = 0; p < rods.size(); ++p) {
    const std::string force = shortest(rods[p].force);
    const std::string centre = shortest(rods[p].centre);
    const std::string width = shortest(rods[p].half_width);
    const auto lines = at(static_cast<unsigned>(p), 1,
                          "[[contact]]\nshape = \"cylinder\"\nforce = " + force +
                              "\ncenter = " + centre + "\nhalf_width = " + width + '\n');
    log += std::to_string(p + 1) + ",cylinder," + force + ",," + centre + ",,," + width + ',' +
           lines[1] + '\n';
  }
  return log;
}

/// What calibrate writes; the folder is that of the scene.
std::string calibrated_scene(const Folder& folder, const std::string& log,
                             const std::string& nominal) {
  const ProcessResult result =
      run_tool({"calibrate", folder.write("log.csv", log), "--scene",
                folder.write("nominal.toml", nominal), "-o", folder / "calibrated.toml"});
  CAPTURE(result.output, result.errors);
  REQUIRE(result.code == 0);
  return read_text(folder / "calibrated.toml");
}

}  // namespace

TEST_CASE("a log simulated from a calibrated scene finds it again", "[cli][calibrate]") {
  const Folder folder;
  const std::string truth = calibrated_scene(folder, read_text(scene("calibration/rod-layer.csv")),
                                             read_text(scene("calibration/rod-layer.toml")));
  const Scene made = parse_scene(truth, "truth.toml");
  const std::string log = log_of_rods(folder, truth, rods(-9e-3, 9e-3, 0.8e-3));
  const Json json = [&] {
    const ProcessResult result =
        run_tool({"calibrate", folder.write("again.csv", log), "--scene",
                  scene("calibration/rod-layer.toml"), "-o", folder / "again.toml", "--json", "-"});
    CAPTURE(result.errors);
    REQUIRE(result.code == 0);
    return Json::parse(result.output);
  }();
  const auto found = [&](const char* parameter, double value) {
    const Json& one = json["parameters"][parameter];
    CAPTURE(parameter, one.dump(), value);
    CHECK(std::abs(one["value"].get<double>() - value) < 3.0 * one["sd"].get<double>());
    CHECK(one["sd"].get<double>() < 0.1 * value);
  };
  found("depth", made.sensor.depths.front());
  found("thickness", made.material.layer->thickness);
  found("poisson_ratio", made.material.poisson_ratio);
  CHECK(std::abs(json["fit"]["rms"].get<double>() - 1.0) < 0.1);
  double pulls = 0.0;
  for (std::size_t j = 0; j < 41; ++j) {
    // [calibration] has what undoes a gain.
    const Json& gain = json["gains"][j];
    pulls += std::pow((gain["value"].get<double>() - 1.0 / made.calibration->gain[j]) /
                          gain["sd"].get<double>(),
                      2) /
             41.0;
  }
  CHECK(pulls < 2.0);
  CHECK(pulls > 0.3);
}

namespace {

/// @param factor  on the depths
std::string positions_scene(double factor) {
  std::string depths;
  for (int i = 0; i < 18; ++i)
    depths += (i > 0 ? ", " : "") + shortest(factor * (i % 3 == 1 ? 1.6 : 1.5));
  return "[units]\nlength = \"mm\"\nstress = \"kPa\"\nmodulus = \"kPa\"\nforce = "
         "\"N/m\"\n[sensor]\n"
         "positions = [-9, -7.8, -6.9, -5.7, -4.4, -3.6, -2.5, -1.4, -0.5, 0.6, 1.8, 2.6, 3.9, "
         "4.7, 5.9, 6.8, 8, 9]\ndepth = [" +
         depths +
         "]  # by the drawing\nreads = [\"stress_x\"]\n[material]\nyoungs_modulus = 200\n"
         "poisson_ratio = 0.45\n[noise]\nrms = 0.4\n[reconstruct]\nalpha = 1e-3\n";
}

/// The same taxels in a file, some of which read a shear as well.
const std::string file_scene = [] {
  std::string text = positions_scene(1.0);
  const std::size_t from = text.find("positions");
  text.replace(from, text.find("[material]") - from,
               "taxels = \"taxels.csv\"  # as built\nreads = [\"stress_x\"]\n");
  return text;
}();

std::string taxel_file(double factor) {
  std::string text = "y,depth,reads\n";
  for (int i = 0; i < 18; ++i)
    text += shortest(-9.0 + 18.0 * i / 17.0 + (i % 3 == 1 ? 0.2 : 0.0)) + ',' +
            shortest((i % 2 == 0 ? 1.5 : 1.8) * factor) +
            (i % 4 == 2 ? ",stress_x shear_xy\n" : ",stress_x\n");
  return text;
}

/// The calibrated scene is solved, planned and run with. @param log  the readings of one press of
/// it
void goes_on(const Folder& folder, const std::string& log) {
  const std::vector<std::string> lines = lines_of(log);
  std::string readings;
  for (const std::string& line : {lines[0], lines[30]}) {
    std::size_t from = 0;
    for (int i = 0; i < 8; ++i) from = line.find(',', from) + 1;
    readings += line.substr(from) + '\n';
  }
  const std::string toml = folder / "calibrated.toml";
  const ProcessResult solved =
      run_tool({"solve", toml, "--readings", folder.write("frame.csv", readings), "-q"});
  CAPTURE(solved.errors);
  CHECK(solved.code == 0);
  const ProcessResult planned = run_tool({"plan", toml, "-o", folder / "pad.plan"});
  CAPTURE(planned.errors);
  CHECK(planned.code == 0);
  const std::string pressed = folder.write(
      "pressed.toml",
      read_text(toml) + "\n[[contact]]\nshape = \"cylinder\"\nforce = 100\nhalf_width = 1\n");
  CHECK(run_tool({"run", pressed}).code == 0);
}

}  // namespace

TEST_CASE("taxels with places of their own are calibrated where they stand", "[cli][calibrate]") {
  const Folder folder;
  const Scene truth = parse_scene(positions_scene(1.0), "truth.toml");
  const std::string log = log_of_rods(folder, positions_scene(1.0), rods(-9.0, 9.0, 0.8));
  const std::string written = calibrated_scene(folder, log, positions_scene(1.2));
  CHECK_THAT(written, ContainsSubstring("]  # by the drawing\n") &&
                          ContainsSubstring("positions = [-9, -7.8, -6.9"));
  const Scene found = read_scene(folder / "calibrated.toml");
  REQUIRE(found.sensor.taxels.size() == 18);
  for (std::size_t i = 0; i < 18; ++i) {
    CHECK_THAT(found.sensor.taxels[i].depth, WithinRel(truth.sensor.taxels[i].depth, 0.04));
    // One factor for all: that is what presses tell.
    CHECK_THAT(found.sensor.taxels[i].depth / found.sensor.taxels[0].depth,
               WithinRel(truth.sensor.taxels[i].depth / truth.sensor.taxels[0].depth, 1e-3));
  }
  goes_on(folder, log);
}

TEST_CASE("taxels of a file come to stand in the calibrated scene", "[cli][calibrate]") {
  const Folder folder;
  folder.write("taxels.csv", taxel_file(1.0));
  const std::string log = log_of_rods(
      folder, replaced(file_scene, "rms = 0.4", "rms = { stress_x = 0.4, shear_xy = 0.3 }"),
      rods(-9.0, 9.0, 0.8));
  folder.write("taxels.csv", taxel_file(0.85));
  const std::string written = calibrated_scene(folder, log, file_scene);
  CHECK_THAT(written, ContainsSubstring("positions = [") && ContainsSubstring("  # as built\n") &&
                          !ContainsSubstring("taxels.csv"));
  CHECK(read_text(folder / "taxels.csv") == taxel_file(0.85));
  std::filesystem::remove(folder / "taxels.csv");  // the calibrated scene is whole without it
  const Scene found = read_scene(folder / "calibrated.toml");
  REQUIRE(found.sensor.taxels.size() == 18);
  CHECK(found.sensor.taxels[2].reads.size() == 2);
  CHECK(found.sensor.taxels[3].reads.size() == 1);
  for (std::size_t i = 0; i < 18; ++i)
    CHECK_THAT(found.sensor.taxels[i].depth, WithinRel(i % 2 == 0 ? 1.5e-3 : 1.8e-3, 0.03));
  goes_on(folder, log);
  // A key that shares its line cannot be written anew.
  folder.write("taxels.csv", taxel_file(0.85));
  const ProcessResult refused =
      run_tool({"calibrate", folder / "log.csv", "--scene",
                folder.write("dotted.toml",
                             replaced(replaced(file_scene, "[sensor]\ntaxels", "sensor.taxels"),
                                      "\nreads", "\nsensor.reads")),
                "-o", folder / "dotted.out.toml"});
  CHECK(refused.code == 2);
  CHECK_FALSE(std::filesystem::exists(folder / "dotted.out.toml"));
}

TEST_CASE("a list of reads for each taxel fits its positions", "[scene]") {
  const std::string pad =
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n[sensor]\npositions = [0, 1, 2]\n"
      "depth = 1\nreads = ";
  const Scene read =
      parse_scene(pad + "[[\"stress_x\"], [\"stress_x\", \"shear_xy\"], [\"shear_xy\"]]\n", "s");
  CHECK(read.sensor.taxels[1].reads == std::vector{Quantity::stress_x, Quantity::shear_xy});
  CHECK(read.sensor.taxels[2].reads == std::vector{Quantity::shear_xy});
  CHECK_THROWS_WITH(parse_scene(pad + "[[\"stress_x\"], [\"stress_x\"]]\n", "s"),
                    ContainsSubstring("of 3 and 2 taxels"));
  CHECK_THROWS_WITH(parse_scene(pad + "[[\"stress_x\"], [], [\"stress_x\"]]\n", "s"),
                    ContainsSubstring("at least one quantity"));
  CHECK_THROWS_WITH(parse_scene(pad + "[[\"stress_x\"], \"stress_x\", [\"stress_x\"]]\n", "s"),
                    ContainsSubstring("quantities"));
}
