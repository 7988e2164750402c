// A curved skin calibrated by the command: logs of balls on a dome whose readings are sums of point
// loads, the scene that is written, contacts that were not in the log, and logs that are wrong.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/calibration/ball_contact.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/calibration/curved_pads.hpp"
#include "tests/catch.hpp"
#include "tests/cli/calibration_logs.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Json = nlohmann::json;

constexpr double dome_radius = 15e-3;
const Material dome_pad{
    .youngs_modulus = 0.24e6, .poisson_ratio = 0.46, .layer = Layer{4e-3, Base::bonded}};

SkinArray dome_skin(double depth) {
  return dome({.side = 6,
               .radius = dome_radius,
               .depth = depth,
               .reads = {Quantity::stress_x, Quantity::shear_xy}});
}

const std::string nominal_dome = R"(# A dome whose numbers are those of its drawing.
title = "A dome"

[units]
length = "mm"
modulus = "MPa"
stress = "Pa"
force = "N"

[sensor]
taxels = "dome.csv"
reads = ["stress_x", "shear_xy"]

[surface]
shape = "sphere"
radius = 15.0

[material]
youngs_modulus = 0.2
poisson_ratio = 0.46
layer = { thickness = 3.6, base = "bonded" }
)";

/// The file of the taxels, 1.5 mm deep where they are 1.8.
std::string taxel_rows() {
  const SkinArray skin = dome_skin(1.5e-3);
  std::string text = "name,x,y,z,nx,ny,nz,depth\n";
  for (std::size_t i = 0; i < skin.taxels.size(); ++i) {
    const SurfacePlace& above = skin.curved->above[i];
    const SpaceVector place = combined(1.0, above.point, 1.5e-3, above.frame[0]);
    text += "t" + std::to_string(i);
    for (const double x : place) text += ',' + shortest(1e3 * x);
    for (const double x : above.frame[0]) text += ',' + shortest(-x);
    text += ",1.5\n";
  }
  return text;
}

/// A dome that was pressed: what its amplifiers do, a log of it, and other contacts.
class PressedDome {
 public:
  explicit PressedDome(unsigned seed) : random_(seed) {
    for (std::size_t j = 0; j < reading_count(skin_); ++j) {
      gains_.push_back(std::exp(0.05 * normal_(random_)));
      offsets_.push_back(200.0 * normal_(random_));
    }
  }

  /// What it says of a ball, in Pa; nothing: of no load.
  std::vector<double> numbers(const PressState* press) {
    std::vector<double> values = press != nullptr ? summed_readings(skin_, dome_pad, *press, 24)
                                                  : std::vector<double>(gains_.size());
    for (std::size_t j = 0; j < values.size(); ++j)
      values[j] = gains_[j] * values[j] + offsets_[j] + noise * normal_(random_);
    return values;
  }

  static PressState ball(double y, double z, double radius, double force) {
    PressState state;
    state.log_force = std::log(force);
    state.center = y;
    state.center_z = z;
    state.log_half_width =
        std::log(ball_contact_radius(dome_pad, force, 1.0 / (1.0 / radius + 1.0 / dome_radius)));
    return state;
  }

  struct Ball {
    double y, z, radius, force;
  };

  /// The first of 14 presses, all over the dome.
  static std::vector<Ball> balls(int count = 14) {
    std::vector<Ball> all;
    for (int p = 0; p < count; ++p)
      all.push_back({1e-3 * (-4.5 + 3.0 * (p / 4) + 0.2 * (p % 3)), 1e-3 * (-4.5 + 3.0 * (p % 4)),
                     1e-3 * (3.0 + 1.3 * (p % 4)), 0.4 + 0.05 * (p % 7)});
    return all;
  }

  /// A log. @param in_space  places in the sensor's axes, else on the chart
  std::string log(bool in_space, const std::vector<Ball>& done = balls()) {
    const std::vector<std::string> names = reading_names(skin_);
    std::string text = std::string("press,shape,force,force_sd,") +
                       (in_space ? "place_x,place_y,place_z" : "position_y,position_z") +
                       ",position_sd,radius,half_width";
    for (std::size_t j = 0; j < names.size(); ++j)
      text += (j < 36 ? ",stress_x_t" : ",shear_xy_t") + std::to_string(j % 36);
    text += '\n';
    for (int row = 0; row < 24; ++row)
      text += "0,none" + std::string(in_space ? 8 : 7, ',') + joined(numbers(nullptr)) + '\n';
    int p = 0;
    for (const auto& [y, z, radius, force] : done) {
      const PressState press = ball(y, z, radius, force);
      text += std::to_string(p + 1) + ",sphere," + shortest(force * (1.0 + 0.01 * (p % 2))) + ',' +
              shortest(0.01 * force);
      if (in_space)
        for (const double x : skin_.curved->surface.at(y, z).point) text += ',' + shortest(1e3 * x);
      else
        text += ',' + shortest(1e3 * y) + ',' + shortest(1e3 * z);
      text += ",0.1," + shortest(1e3 * radius) + ',' + joined(numbers(&press)) + '\n';
      ++p;
    }
    return text;
  }

  [[nodiscard]] const std::vector<double>& gains() const { return gains_; }
  [[nodiscard]] const std::vector<double>& offsets() const { return offsets_; }

  static std::string joined(const std::vector<double>& values) {
    std::string text;
    for (const double value : values) text += ',' + shortest(value);
    return text;
  }

 private:
  static constexpr double noise = 60.0;
  SkinArray skin_ = dome_skin(1.8e-3);
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_{};
  std::vector<double> gains_{}, offsets_{};
};

/// The scene and its taxels in a folder.
std::string write_dome(const Folder& folder, const std::string& table = "") {
  folder.write("dome.csv", taxel_rows());
  return folder.write("nominal.toml", nominal_dome + table);
}

Json calibrated_dome(const Folder& folder, const std::string& log) {
  const ProcessResult result =
      run_tool({"calibrate", folder.write("log.csv", log), "--scene", write_dome(folder), "-o",
                folder / "calibrated.toml", "--json", folder / "found.json"});
  CAPTURE(result.output, result.errors);
  REQUIRE(result.code == 0);
  return Json::parse(read_text(folder / "found.json"));
}

}  // namespace

TEST_CASE("a dome's depth, thickness, modulus and gains are found from balls",
          "[cli][calibrate][curved]") {
  const Folder folder;
  PressedDome pressed(3);
  const Json json = calibrated_dome(folder, pressed.log(true));
  CHECK(json["fit"]["verdict"] == "ok");
  CHECK(std::abs(json["fit"]["rms"].get<double>() - 1.0) < 0.08);
  const auto check_near = [&](const char* parameter, double truth, double most_sd) {
    const Json& one = json["parameters"][parameter];
    CAPTURE(parameter, one.dump());
    CHECK(std::abs(one["value"].get<double>() - truth) <= 3.0 * one["sd"].get<double>());
    CHECK(one["sd"].get<double>() <= most_sd);
  };
  check_near("depth", 1.8e-3, 0.03e-3);
  check_near("thickness", 4e-3, 0.2e-3);
  check_near("youngs_modulus", 0.24e6, 0.02e6);
  CHECK(gains_left(json, pressed.gains()) < 0.03);

  // The scene that is written is read, and is the same surface with deeper taxels.
  const std::string text = read_text(folder / "calibrated.toml");
  CHECK(text.substr(0, 20) == nominal_dome.substr(0, 20));
  CHECK_THAT(text, ContainsSubstring("depth_factor = 1."));
  const auto written = std::get<SkinScene>(read_any_scene(folder / "calibrated.toml"));
  const auto stated = std::get<SkinScene>(read_any_scene(folder / "nominal.toml"));
  REQUIRE(written.sensor.curved);
  REQUIRE(written.calibration);
  CHECK_THAT(written.sensor.depths.front(),
             WithinRel(json["parameters"]["depth"]["value"].get<double>(), 1e-4));
  CHECK(written.sensor.curved->surface.curvature() == stated.sensor.curved->surface.curvature());
  CHECK(written.sensor.curved->above[3].point == stated.sensor.curved->above[3].point);

  // Contacts that were not in the log: the calibrated scene takes what the sensor says, the
  // nominal one is spared its offsets.
  std::string raw, tared;
  const std::vector<std::string> names = reading_names(dome_skin(1.8e-3));
  for (std::size_t j = 0; j < names.size(); ++j)
    raw += (j > 0 ? "," : "") + std::string(j < 36 ? "stress_x_t" : "shear_xy_t") +
           std::to_string(j % 36);
  tared = raw += '\n';
  std::vector<SpaceVector> forces;
  for (int i = 0; i < 4; ++i) {
    const PressState press =
        PressedDome::ball(1e-3 * (-2.0 + 1.3 * i), 1e-3 * (1.5 - i), 5e-3, 0.5);
    std::vector<double> numbers = pressed.numbers(&press);
    raw += PressedDome::joined(numbers).substr(1) + '\n';
    for (std::size_t j = 0; j < numbers.size(); ++j) numbers[j] -= pressed.offsets()[j];
    tared += PressedDome::joined(numbers).substr(1) + '\n';
    const SkinArray skin = dome_skin(1.8e-3);
    forces.push_back(combined(0.5, skin.curved->surface.at(press.center, press.center_z).frame[0],
                              0.0, SpaceVector{}));
  }
  const auto error = [&](const std::string& scene, const std::string& readings) {
    const ProcessResult solved =
        run_tool({"solve", scene, "--readings", folder.write("readings.csv", readings), "--json",
                  folder / "solved.json", "-q"});
    CAPTURE(solved.errors);
    REQUIRE(solved.code == 0);
    const Json rows = Json::parse(read_text(folder / "solved.json"))["rows"];
    double most = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      SpaceVector found{};
      for (std::size_t k = 0; k < 3; ++k)
        found[k] = rows[i]["resultant"]["force"][k]["value"].get<double>();
      most = std::max(most, length(combined(1.0, found, -1.0, forces[i])) / length(forces[i]));
    }
    return most;
  };
  const double before =
      error(folder.write("tared.toml", nominal_dome + "\n[noise]\nrms = 60.0\n"), tared);
  const double after = error(folder / "calibrated.toml", raw);
  CAPTURE(before, after);
  CHECK(after < 0.06);
  CHECK(after < 0.7 * before);
}

TEST_CASE("a dome's next press tells as much of the depth as was said before it was done",
          "[cli][calibrate][curved]") {
  const Folder folder;
  const std::string scene = write_dome(folder);
  std::vector<PressedDome::Ball> done = PressedDome::balls(4);
  const auto calibrated = [&](const std::vector<PressedDome::Ball>& balls) {
    const ProcessResult result =
        run_tool({"calibrate", folder.write("log.csv", PressedDome(4).log(true, balls)), "--scene",
                  scene, "--next", "2", "--target", "depth", "--json", folder / "found.json"});
    CAPTURE(result.output, result.errors);
    REQUIRE(result.code == 0);
    CHECK_THAT(result.output,
               ContainsSubstring("contact radius") && ContainsSubstring("of the depth is unknown"));
    return Json::parse(read_text(folder / "found.json"));
  };
  const auto unknown_of = [](const Json& json) {
    const Json& depth = json["parameters"]["depth"];
    return depth["sd"].get<double>() / depth["value"].get<double>();
  };
  const Json before = calibrated(done);
  CHECK_THAT(before["unknown_now"].get<double>(), WithinRel(unknown_of(before), 0.1));
  REQUIRE(before["next"].size() == 2);
  for (const Json& next : before["next"]) {
    REQUIRE(next["shape"] == "sphere");
    done.push_back({next["position"].get<double>(), next["position_z"].get<double>(),
                    next["radius"].get<double>(), next["force"].get<double>()});
    const Json after = calibrated(done);
    const double said = next["unknown_then"].get<double>();
    CHECK_THAT(unknown_of(after), WithinRel(said, 0.15));
    CHECK(said < 0.95 * unknown_of(before));
  }
}

TEST_CASE("places of presses on the chart are those in space", "[cli][calibrate][curved]") {
  const Folder folder;
  const Json space = calibrated_dome(folder, PressedDome(5).log(true));
  const Json chart = calibrated_dome(folder, PressedDome(5).log(false));
  for (const char* parameter : {"depth", "thickness", "youngs_modulus"})
    CHECK_THAT(space["parameters"][parameter]["value"].get<double>(),
               WithinRel(chart["parameters"][parameter]["value"].get<double>(), 1e-6));
}

TEST_CASE("a dome's log that is wrong is refused with its line and the rule",
          "[cli][calibrate][curved]") {
  const Folder folder;
  const std::string text = PressedDome(7).log(true);
  const auto errors = [&](const std::string& log, const std::string& table = "") {
    const ProcessResult result = run_tool({"calibrate", folder.write("log.csv", log), "--scene",
                                           write_dome(folder, table), "-o", folder / "out.toml"});
    CHECK(result.code == 2);
    return result.errors;
  };
  CHECK_THAT(errors(replaced(text, "half_width", "position_y")),
             ContainsSubstring("keep one of the two"));
  CHECK_THAT(errors(text, "\n[calibrate]\npitch_sd = 0.01\n"), ContainsSubstring("pitch_sd"));
  // Two thirds of the way to the middle of the ball.
  const std::size_t row = text.find("\n1,sphere,");
  const std::size_t place = text.find(",0.1,", row);
  const std::size_t third = text.rfind(',', place - 1);
  CHECK_THAT(errors(text.substr(0, third) + ",-10" + text.substr(place)),
             ContainsSubstring("log.csv:26") && ContainsSubstring("outside of the skin's surface"));
  CHECK_THAT(errors(text.substr(0, third) + ',' + text.substr(place)),
             ContainsSubstring("three numbers"));
}

TEST_CASE("one press on a dome says by name what it cannot tell", "[cli][calibrate][curved]") {
  const Folder folder;
  std::string text = PressedDome(9).log(true);
  text = text.substr(0, text.find("\n2,sphere,") + 1);
  const ProcessResult result = run_tool({"calibrate", folder.write("log.csv", text), "--scene",
                                         write_dome(folder), "-o", folder / "out.toml"});
  CAPTURE(result.output, result.errors);
  CHECK_THAT(result.output, ContainsSubstring("depth and gains cannot be told apart"));
}

TEST_CASE("a cap of finite elements tells its depth, thickness and modulus from three contacts",
          "[cli][calibrate][curved]") {
  // scenes/recorded/curved-pad: frames 1, 3 and 7 are single round contacts of known pressure, the
  // latter two dragged. Nothing of the project made their readings.
  struct Contact {
    std::size_t frame;
    SpaceVector at;  // [m]
    double radius, peak, friction;
    SpaceVector direction;
  };
  const std::vector<Contact> contacts = {
      {1,
       {-0.00059424880751387, -1.1551933980691625e-06, 0.029994113872896737},
       0.0024,
       20000.0,
       0.0,
       {0.0, 1.0, 0.0}},
      {3,
       {-0.004364629725114088, 0.0028344468752644126, 0.02954515050349133},
       0.0024,
       24000.0,
       0.3,
       {-1.8473247989741095, 1.5665487746995206, 0.3}},
      {7,
       {0.007511485812170524, 0.0013380764913031864, 0.029013568070766178},
       0.0024,
       20000.0,
       0.3,
       {0.0, 1.0, 0.2}}};
  const Folder folder;
  folder.write("cap-taxels.csv", read_text(scene("recorded/curved-pad/cap-taxels.csv")));
  std::string nominal = read_text(scene("recorded/curved-pad/cap.toml"));
  const auto cap = std::get<SkinScene>(read_any_scene(scene("recorded/curved-pad/cap.toml")));
  nominal = replaced(nominal, "youngs_modulus = 0.25", "youngs_modulus = 0.18");
  nominal = replaced(nominal, "thickness = 4.0", "thickness = 3.4");
  nominal = replaced(nominal, "frame = \"sensor\"", "depth_factor = 0.8\nframe = \"sensor\"");
  nominal +=
      "\n[calibrate]\ngain_sd = 0.0\nmean_gain_sd = 0.0\ndepth_sd = \"unknown\"\n"
      "thickness_sd = \"unknown\"\nyoungs_modulus_sd = \"unknown\"\n";

  const std::vector<std::string> rows = lines_of(read_text(scene("recorded/curved-pad/cap.csv")));
  const std::string columns = rows[0].substr(rows[0].find(','));
  std::string log =
      "press,shape,force,force_sd,place_x,place_y,place_z,position_sd,radius,half_width,friction,"
      "direction" +
      columns + '\n';
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0.0, 1e-3);
  for (int i = 0; i < 20; ++i) {
    log += "0,none" + std::string(10, ',');
    for (std::size_t j = 0; j < 300; ++j) log += ',' + shortest(noise(random));
    log += '\n';
  }
  for (const Contact& one : contacts) {
    const auto at = cap.sensor.curved->surface.chart(one.at);
    const SurfaceFrame frame = cap.sensor.curved->surface.at(at.y, at.z).frame;
    const double angle = std::atan2(dot(one.direction, frame[2]), dot(one.direction, frame[1]));
    // The integral of peak sqrt(1 - s^2) over the disc.
    const double force = 2.0 / 3.0 * std::numbers::pi * one.radius * one.radius * one.peak;
    log += std::to_string(one.frame) + ",sphere," + shortest(force) + ",0.0";
    for (const double x : one.at) log += ',' + shortest(1e3 * x);
    log += ",,," + shortest(1e3 * one.radius) + ',' + shortest(one.friction) + ',' +
           (one.friction > 0.0 ? shortest(angle * 180.0 / std::numbers::pi) : std::string()) +
           rows[one.frame + 1].substr(rows[one.frame + 1].find(',')) + '\n';
  }
  const ProcessResult result = run_tool({"calibrate", folder.write("log.csv", log), "--scene",
                                         folder.write("cap.toml", nominal), "-o",
                                         folder / "out.toml", "--json", folder / "found.json"});
  CAPTURE(result.output, result.errors);
  REQUIRE(result.code == 0);
  const Json json = Json::parse(read_text(folder / "found.json"));
  const auto value = [&](const char* parameter) {
    return json["parameters"][parameter]["value"].get<double>();
  };
  // The mesh is 0.8 % off the exact layer.
  CHECK_THAT(value("depth"), WithinRel(1.2e-3, 0.02));
  CHECK_THAT(value("thickness"), WithinRel(4e-3, 0.015));
  CHECK_THAT(value("youngs_modulus"), WithinRel(0.25e6, 0.02));
  CHECK_THAT(value("poisson_ratio"), WithinAbs(0.48, 0.005));
  CHECK(json["fit"]["rms"].get<double>() < 1.3);
}
