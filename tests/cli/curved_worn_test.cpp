// A worn dome: gains, crosstalk, drifting offsets, a coarse converter, a dead and a stuck taxel.
// `check` names the broken ones, and after what it advises the forces hold.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/calibration/ball_contact.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/sensing/effects/crosstalk.hpp"
#include "tactile_net/skin/signal_layout.hpp"
#include "tests/calibration/curved_pads.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Json = nlohmann::json;

constexpr std::size_t side = 7;
constexpr double worn_radius = 20e-3;
constexpr double worn_depth = 1.8e-3;
constexpr std::size_t dead = 17, stuck = 31;
constexpr double worn_noise = 60.0;  // Pa, of some 15 kPa
constexpr double worn_step = 125.0;  // of the converter
constexpr std::size_t frames_of_a_press = 100, frames_at_rest = 40, frame_held = 70;
const Material worn_pad{
    .youngs_modulus = 0.25e6, .poisson_ratio = 0.47, .layer = Layer{4e-3, Base::bonded}};

/// One of the presses of a recording.
struct WornPress {
  PressState state{};
  SpaceVector force{};   ///< on the skin [N]
  SpaceVector moment{};  ///< about the origin [N m]
};

struct WornDome {
  std::vector<WornPress> presses{};
  std::vector<std::vector<double>> frames{};
};

SkinArray worn_skin() {
  return dome({.side = side,
               .radius = worn_radius,
               .depth = worn_depth,
               .reads = {Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz}});
}

WornDome worn_dome(unsigned seed) {
  const SkinArray skin = worn_skin();
  const std::size_t n = reading_count(skin), taxels = taxel_count(skin);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  WornDome made;
  std::vector<double> gains(n), offsets(n), drifts(n);
  for (std::size_t j = 0; j < n; ++j) {
    gains[j] = std::exp(0.06 * normal(random));
    offsets[j] = 400.0 * normal(random);
    drifts[j] = 1.0 * normal(random);  // a frame
  }
  const auto leaks = make_effect(Crosstalk{0.03}, signal_layout(skin));
  for (int p = 0; p < 4; ++p) {
    PressState state;
    const double force = uniform(0.3, 0.7);
    state.log_force = std::log(force);
    state.center = uniform(-3e-3, 3e-3);
    state.center_z = uniform(-3e-3, 3e-3);
    state.log_half_width = std::log(ball_contact_radius(
        worn_pad, force, 1.0 / (1.0 / uniform(4e-3, 8e-3) + 1.0 / worn_radius)));
    state.friction = p % 2 == 0 ? 0.0 : uniform(-0.4, 0.4);
    state.friction_z = p % 2 == 0 ? 0.0 : uniform(-0.4, 0.4);
    const std::vector<double> clean = summed_readings(skin, worn_pad, state, 24);
    // Pressure and drag over a small disc turn little: what is lost of the force is a^2 / (5 R^2).
    const SurfacePlace at = skin.curved->surface.at(state.center, state.center_z);
    const double a = std::exp(state.log_half_width);
    const double turned = 1.0 - 0.2 * std::pow(a / worn_radius, 2);
    SpaceVector total = combined(state.friction, at.frame[1], state.friction_z, at.frame[2]);
    total = combined(force * turned, at.frame[0], force, total);
    made.presses.push_back({state, total, cross(at.point, total)});
    for (std::size_t k = 0; k < frames_of_a_press; ++k) {
      // 40 frames at rest, 15 that press, 25 held, 15 that let go.
      const double into = static_cast<double>(k) - static_cast<double>(frames_at_rest);
      const double pressed = std::clamp(std::min(into / 15.0, (55.0 - into) / 15.0), 0.0, 1.0);
      std::vector<double> frame = clean;
      for (double& value : frame) value *= pressed;
      leaks->apply(Instant{}, frame);
      const double time = static_cast<double>(made.frames.size());
      for (std::size_t j = 0; j < n; ++j) {
        double value =
            gains[j] * frame[j] + offsets[j] + drifts[j] * time + worn_noise * normal(random);
        value = worn_step * std::round(value / worn_step);
        if (j % taxels == dead) value = 0.0;
        if (j % taxels == stuck) value = 1250.0;
        frame[j] = value;
      }
      made.frames.push_back(std::move(frame));
    }
  }
  return made;
}

std::string worn_rows(const SkinArray& skin) {
  std::string text = "name,x,y,z,nx,ny,nz,depth\n";
  for (std::size_t i = 0; i < skin.taxels.size(); ++i) {
    const SurfacePlace& above = skin.curved->above[i];
    text += "t" + std::to_string(i);
    for (const double x : combined(1.0, above.point, worn_depth, above.frame[0]))
      text += ',' + shortest(1e3 * x);
    for (const double x : above.frame[0]) text += ',' + shortest(-x);
    text += ',' + shortest(1e3 * worn_depth) + '\n';
  }
  return text;
}

const std::string worn_scene = R"(
[units]
length = "mm"
modulus = "MPa"
stress = "Pa"
force = "N"
[sensor]
taxels = "worn.csv"
reads = ["stress_x", "shear_xy", "shear_xz"]
[surface]
shape = "sphere"
[material]
youngs_modulus = 0.25
poisson_ratio = 0.47
layer = { thickness = 4.0, base = "bonded" }
[noise]
rms = 100.0
)";

std::string as_csv(const std::vector<std::vector<double>>& frames) {
  std::string text;
  for (const char* quantity : {"stress_x_t", "shear_xy_t", "shear_xz_t"})
    for (std::size_t i = 0; i < side * side; ++i)
      text += (text.empty() ? "" : ",") + std::string(quantity) + std::to_string(i);
  text += '\n';
  for (const std::vector<double>& frame : frames) {
    for (std::size_t j = 0; j < frame.size(); ++j) text += (j > 0 ? "," : "") + shortest(frame[j]);
    text += '\n';
  }
  return text;
}

}  // namespace

TEST_CASE("a worn dome's broken taxels are named, and without them its forces hold",
          "[cli][curved]") {
  double within = 0.0, count = 0.0;
  for (const unsigned seed : {1U, 2U}) {
    const Folder folder;
    const WornDome worn = worn_dome(seed);
    folder.write("worn.csv", worn_rows(worn_skin()));
    const std::string scene = folder.write("worn.toml", worn_scene);
    const ProcessResult checked =
        run_tool({"check", scene, "--readings", folder.write("raw.csv", as_csv(worn.frames)),
                  "--json", folder / "check.json"});
    CAPTURE(seed, checked.output, checked.errors);
    const auto named = [&](const std::string& kind) {
      const Json findings = Json::parse(read_text(folder / "check.json"))["findings"];
      for (const Json& one : findings)
        if (one["kind"] == kind) return one["taxels"].get<std::vector<std::size_t>>();
      return std::vector<std::size_t>();
    };
    CHECK(named("dead_taxels") == std::vector<std::size_t>{dead});
    CHECK(named("stuck_taxels") == std::vector<std::size_t>{stuck});
    CHECK_THAT(checked.output, ContainsSubstring("\"t" + std::to_string(dead) + "\"") &&
                                   ContainsSubstring("\"t" + std::to_string(stuck) + "\""));
    // What it advises: the two are dead to the scene, and each press has a zero of its own, the
    // mean of the frames before it.
    std::vector<std::vector<double>> tared;
    for (std::size_t p = 0; p < worn.presses.size(); ++p) {
      const std::size_t first = p * frames_of_a_press;
      std::vector<double> held = worn.frames[first + frame_held];
      for (std::size_t j = 0; j < held.size(); ++j)
        for (std::size_t k = 0; k < frames_at_rest; ++k)
          held[j] -= worn.frames[first + k][j] / static_cast<double>(frames_at_rest);
      tared.push_back(std::move(held));
    }
    const std::string advised = worn_scene + "[dead_taxels]\nindices = [\"t" +
                                std::to_string(dead) + "\", \"t" + std::to_string(stuck) + "\"]\n";
    const ProcessResult solved = run_tool({"solve", folder.write("advised.toml", advised),
                                           "--readings", folder.write("tared.csv", as_csv(tared)),
                                           "--json", folder / "solved.json", "-q"});
    CAPTURE(solved.errors);
    REQUIRE(solved.code == 0);
    const Json rows = Json::parse(read_text(folder / "solved.json"))["rows"];
    for (std::size_t p = 0; p < worn.presses.size(); ++p) {
      const Json& found = rows[p]["resultant"];
      SpaceVector off{};
      for (std::size_t k = 0; k < 3; ++k)
        for (const auto& [key, truth] : {std::pair{"force", worn.presses[p].force},
                                         std::pair{"moment", worn.presses[p].moment}}) {
          const double apart = found[key][k]["value"].get<double>() - truth[k];
          const double sd = found[key][k]["deviation"].get<double>();
          if (key == std::string("force")) off[k] = apart;
          within += std::abs(apart) <= 2.0 * sd ? 1.0 : 0.0;
          count += 1.0;
        }
      CHECK(length(off) <= 0.16 * length(worn.presses[p].force));
    }
  }
  CAPTURE(within / count);
  CHECK(within >= 0.8 * count);
}
