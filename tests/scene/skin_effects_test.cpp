// The effects of a skin's scene: on one row each is the line's, bit for bit, whatever the order of
// the tables; taxels are named by number, row and column, or name; what is wrong is said.
#include <string>
#include <vector>

#include "bench/effect_tables.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/scene_effects.hpp"
#include "tests/catch.hpp"
#include "tests/scene/refusal.hpp"
#include "tests/scene/signal_frames.hpp"

namespace {

using namespace tactile_net;
using test::bits;
using test::moving;
using test::signal_frames;

const std::string sensor_rest =
    "pitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\", \"stress_y\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n";
const std::string time_table = "[time]\nrate = 10.0\nframes = 21\n";
const std::string weights = "[noise]\nrms = { strain_x = 0.5, stress_y = 0.25 }\n";

Scene line_with(const std::string& tables) {
  return parse_scene("[sensor]\ncount = 5\n" + sensor_rest + time_table + tables, "line.toml");
}

SkinScene skin_with(const std::string& tables,
                    const std::string& sensor = "rows = 1\ncolumns = 5\n") {
  return std::get<SkinScene>(
      parse_any_scene("[sensor]\n" + sensor + sensor_rest + time_table + tables, "skin.toml"));
}

std::vector<Diagnostic> problems_with(const std::string& tables) {
  return test::diagnostics_of([&] { return skin_with(tables, "rows = 3\ncolumns = 4\n"); });
}

}  // namespace

TEST_CASE("each effect on a skin of one row or one column is the line's, bit for bit",
          "[scene][skin][effects]") {
  const auto none = bits(signal_frames(line_with(weights), moving));
  for (const bench::EffectTable& table : bench::effect_tables) {
    CAPTURE(table.name);
    const std::string own = (table.name == "noise" ? "" : weights) +
                            (table.name == "noise" ? weights : std::string(table.toml));
    const auto of_line = bits(signal_frames(line_with(own), moving));
    CHECK(bits(signal_frames(skin_with(own), moving)) == of_line);
    CHECK(bits(signal_frames(skin_with(own, "rows = 5\ncolumns = 1\n"), moving)) == of_line);
    if (table.name != "noise") CHECK_FALSE(of_line == none);
    for (const auto& [name, present] : effects(skin_with(own)))
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
  const auto of_line = bits(signal_frames(line_with(forwards), moving));
  CHECK(bits(signal_frames(skin_with(forwards), moving)) == of_line);
  CHECK(bits(signal_frames(skin_with(backwards), moving)) == of_line);
  // What is broken for good comes last: neither noise nor the converter moves it.
  const SkinScene broken = skin_with(forwards + "[stuck_taxels]\nindices = [1]\nvalues = [9]\n");
  for (const std::vector<double>& frame : signal_frames(broken, moving)) {
    CHECK(frame[1] == 9.0);
    CHECK(frame[3] == 0.0);
  }
}

TEST_CASE("moments between frames are those of the line", "[scene][skin][effects]") {
  const std::string windows = weights + "[sampling]\naperture = 0.025\n";
  const auto of_line = instants(line_with(windows));
  const auto of_skin = instants(skin_with(windows));
  REQUIRE(of_skin.size() == of_line.size());
  CHECK(of_skin.size() > 21);
  for (std::size_t i = 0; i < of_skin.size(); ++i) CHECK(of_skin[i].since == of_line[i].since);
  CHECK(instants(skin_with(weights)).size() == 21);
}

TEST_CASE("in two dimensions a taxel leaks to four, and no further", "[scene][skin][effects]") {
  const SkinScene scene =
      skin_with(weights + "[crosstalk]\nfraction = 0.25\n", "rows = 3\ncolumns = 4\n");
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
  CHECK(scene.saturation->range.at(Quantity::displacement_y).high == 1e-3);
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
    return skin_with(weights + "[dead_taxels]\nindices = " + list + "\n", sensor).dead_taxels;
  };
  CHECK(dead("[6, 7]") == std::vector<std::size_t>{6, 7});
  CHECK(dead("[[1, 2], \"1_3\"]") == std::vector<std::size_t>{6, 7});
  const SkinScene scene =
      skin_with(weights + "[taxel_noise]\nindices = [[2, 3], \"0_1\"]\nrms = [1.0, 2.0]\n", sensor);
  CHECK(scene.taxel_noise->rms.at(Quantity::strain_x)[11] == 1.0);
  CHECK(scene.taxel_noise->rms.at(Quantity::stress_y)[1] == 2.0);
}

TEST_CASE("what is wrong with a skin's effects is said once, at its place",
          "[scene][skin][effects]") {
  const auto check = [](const std::string& table, std::string_view message, std::string_view hint) {
    CAPTURE(table);
    const auto problems = problems_with(weights + table);
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
