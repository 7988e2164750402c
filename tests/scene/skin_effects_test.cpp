// The effects of a skin's scene: on one row each is the line's, bit for bit, whatever the order of
// the tables; taxels are named by number, row and column, or name; what is wrong is said.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/effect_tables.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/scene_effects.hpp"
#include "tests/catch.hpp"

namespace {

using namespace tactile_net;

const std::string rest =
    "pitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\", \"stress_y\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n";
const std::string time = "[time]\nrate = 10.0\nframes = 21\n";
const std::string weights = "[noise]\nrms = { strain_x = 0.5, stress_y = 0.25 }\n";

Scene line(const std::string& tables) {
  return parse_scene("[sensor]\ncount = 5\n" + rest + time + tables, "line.toml");
}

SkinScene skin(const std::string& tables, const std::string& sensor = "rows = 1\ncolumns = 5\n") {
  return std::get<SkinScene>(
      parse_any_scene("[sensor]\n" + sensor + rest + time + tables, "skin.toml"));
}

std::vector<Diagnostic> problems_of(const std::string& tables) {
  try {
    (void)skin(tables, "rows = 3\ncolumns = 4\n");
  } catch (const InputError& error) {
    return error.diagnostics();
  }
  return {};
}

/// All frames of a signal that moves, with zeros of either sign in it.
std::vector<double> frames(const auto& scene, std::size_t readings) {
  SignalPath path = signal_path(scene);
  std::vector<double> all;
  for (const Instant& at : instants(scene)) {
    std::vector<double> now;
    for (std::size_t i = 0; i < readings; ++i)
      now.push_back(i == 3 ? -0.0 : i == 4 ? 0.0 : std::sin(at.time + static_cast<double>(i)));
    path.apply(at, now);
    if (at.recorded) all.insert(all.end(), now.begin(), now.end());
  }
  return all;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
           return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
         });
}

}  // namespace

TEST_CASE("each effect on a skin of one row or one column is the line's, bit for bit",
          "[scene][skin][effects]") {
  const std::vector<double> none = frames(line(weights), 10);
  for (const bench::EffectTable& table : bench::effect_tables) {
    CAPTURE(table.name);
    const std::string own = (table.name == "noise" ? "" : weights) +
                            (table.name == "noise" ? weights : std::string(table.toml));
    const std::vector<double> of_line = frames(line(own), 10);
    CHECK(same_bits(frames(skin(own), 10), of_line));
    CHECK(same_bits(frames(skin(own, "rows = 5\ncolumns = 1\n"), 10), of_line));
    if (table.name != "noise") CHECK_FALSE(same_bits(of_line, none));
    for (const auto& [name, present] : effects(skin(own)))
      CHECK(present == (name == table.name || name == "noise"));
  }
}

TEST_CASE("all effects at once, in any order of the file, pass a skin in the path's order",
          "[scene][skin][effects]") {
  std::string forwards = weights;
  std::string backwards = weights;
  for (const bench::EffectTable& table : bench::effect_tables) {
    if (table.name == "noise" || table.name == "stuck_taxels") continue;
    forwards += table.toml;
    backwards.insert(0, table.toml);
  }
  const std::vector<double> of_line = frames(line(forwards), 10);
  CHECK(same_bits(frames(skin(forwards), 10), of_line));
  CHECK(same_bits(frames(skin(backwards), 10), of_line));
  // What is broken for good comes last: neither noise nor the converter moves it.
  const auto broken = frames(skin(forwards + "[stuck_taxels]\nindices = [1]\nvalues = [9]\n"), 10);
  for (std::size_t k = 0; k < broken.size(); k += 10) {
    CHECK(broken[k + 1] == 9.0);
    CHECK(broken[k + 3] == 0.0);
  }
}

TEST_CASE("moments between frames are those of the line", "[scene][skin][effects]") {
  const std::string windows = weights + "[sampling]\naperture = 0.025\n";
  const auto of_line = instants(line(windows));
  const auto of_skin = instants(skin(windows));
  REQUIRE(of_skin.size() == of_line.size());
  CHECK(of_skin.size() > 21);
  for (std::size_t i = 0; i < of_skin.size(); ++i) CHECK(of_skin[i].since == of_line[i].since);
  CHECK(instants(skin(weights)).size() == 21);
}

TEST_CASE("in two dimensions a taxel leaks to four, and no further", "[scene][skin][effects]") {
  const SkinScene scene =
      skin(weights + "[crosstalk]\nfraction = 0.25\n", "rows = 3\ncolumns = 4\n");
  SkinScene quiet = scene;
  quiet.noise.reset();
  SignalPath path = signal_path(quiet);
  std::vector<double> readings(24);
  readings[12 + 5] = 1.0;
  path.apply(Instant{}, readings);
  for (std::size_t i = 0; i < 24; ++i) {
    const bool neighbour = i == 12 + 1 || i == 12 + 4 || i == 12 + 6 || i == 12 + 9;
    CHECK(readings[i] == (neighbour ? 0.25 : 0.0));
  }
}

TEST_CASE("a skin's ranges are of each quantity, in its unit", "[scene][skin][effects]") {
  const std::string mixed =
      "[units]\nlength = \"mm\"\nstress = \"kPa\"\n[sensor]\nrows = 2\ncolumns = 2\npitch = 1\n"
      "depth = 1\nreads = [\"stress_x\", \"displacement_y\"]\n"
      "[material]\nyoungs_modulus = 1e5\npoisson_ratio = 0.45\n"
      "[noise]\nrms = { stress_x = 1, displacement_y = 0.1 }\n";
  const std::string ranges = "range = { stress_x = [-50, 50], displacement_y = [-1, 1] }\n";
  const auto scene = std::get<SkinScene>(parse_any_scene(
      mixed + "[saturation]\n" + ranges + "[quantization]\nbits = 1\n" + ranges, "skin.toml"));
  CHECK(scene.saturation->range.at(SkinQuantity::displacement_y).high == 1e-3);
  SkinScene quiet = scene;
  quiet.noise.reset();
  SignalPath path = signal_path(quiet);
  std::vector<double> readings{10e3, -10e3, 60e3, 1.0, 0.1e-3, -0.1e-3, 2e-3, -2e-3};
  path.apply(Instant{}, readings);
  const std::vector<double> expected{50e3, -50e3, 50e3, 50e3, 1e-3, -1e-3, 1e-3, -1e-3};
  CHECK(readings == expected);
  REQUIRE(path.notes().size() == 1);  // the converter gets what the amplifiers let through
  CHECK(path.notes()[0].cut_off == 3);
  try {
    (void)parse_any_scene(mixed + "[quantization]\nbits = 1\nrange = [-1, 1]\n", "skin.toml");
    FAIL("one range of two units is taken");
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), ContainsSubstring("differ in their units"));
  }
}

TEST_CASE("taxels are named by number, by row and column, or by name", "[scene][skin][effects]") {
  const std::string sensor = "rows = 3\ncolumns = 4\n";
  const auto dead = [&](const std::string& list) {
    return skin(weights + "[dead_taxels]\nindices = " + list + "\n", sensor).dead_taxels;
  };
  CHECK(dead("[6, 7]") == std::vector<std::size_t>{6, 7});
  CHECK(dead("[[1, 2], \"1_3\"]") == std::vector<std::size_t>{6, 7});
  const SkinScene scene =
      skin(weights + "[taxel_noise]\nindices = [[2, 3], \"0_1\"]\nrms = [1.0, 2.0]\n", sensor);
  CHECK(scene.taxel_noise->rms.at(SkinQuantity::strain_x)[11] == 1.0);
  CHECK(scene.taxel_noise->rms.at(SkinQuantity::stress_y)[1] == 2.0);
}

TEST_CASE("what is wrong with a skin's effects is said once, at its place",
          "[scene][skin][effects]") {
  const auto check = [](const std::string& table, std::string_view message, std::string_view hint) {
    CAPTURE(table);
    const auto problems = problems_of(weights + table);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].line >= 13);
    CHECK_THAT(problems[0].message + " | " + problems[0].hint,
               ContainsSubstring(std::string(message)) && ContainsSubstring(std::string(hint)));
  };
  check("[crosstalk]\nfraction = 0.3\n", "must be from 0 to 0.25 (got 0.3)", "most neighbours");
  check("[dead_taxels]\nindices = [12]\n", "must be from 0 to 11", "row, column");
  check("[dead_taxels]\nindices = [[3, 0]]\n", "must be from 0 to 2", "rows");
  check("[dead_taxels]\nindices = [[0, 1, 2]]\n", "a row and a column", "[0, 3]");
  check("[dead_taxels]\nindices = [\"3_0\"]\n", "names no taxel (got", "3_5");
  check("[dead_taxels]\nindices = [5, \"1_1\"]\n", "names a taxel twice", "remove one");
  check("[gain_error]\nvalues = [1.0]\n", "one value per taxel: 12", "");
  check("[saturation]\nrange = { strain_x = [0, 1], stress_y = [0, 1], stress_x = [0, 1] }\n",
        "sensor.reads does not name", "");
  check("[low_pass]\ncutof = 1.0\n", "unknown key", "cutoff");
}
