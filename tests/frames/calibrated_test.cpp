// The door: a file's numbers become readings in SI.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/frames/open.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::frames;

namespace {

using Numbers = std::vector<double>;

Scene scene_with(const std::string& more) {
  return parse_scene(
      "[sensor]\ncount = 2\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1\npoisson_ratio = 0.4\n" +
          more,
      "scene.toml");
}

struct Read {
  std::vector<Numbers> frames{};
  std::vector<std::string> times{};
  std::string error{};
  std::optional<Calibration> calibration{};
};

/// All frames of a text on standard input.
Read read_frames(const Scene& scene, const std::string& text, bool accept_missing = false) {
  std::istringstream in(text);
  ReadingsFile file("-", scene, &in, {.accept_missing = accept_missing});
  Read result;
  try {
    for (Numbers frame(2); file.source().next(frame);) {
      result.frames.push_back(frame);
      result.times.emplace_back(file.source().time());
    }
  } catch (const InputError& error) {
    result.error = error.what();
  }
  if (file.calibration() != nullptr) result.calibration = *file.calibration();
  return result;
}

const std::string four_frames = "t,stress_x_0,stress_x_1\n0,1,2\n1,3,6\n2,10,20\n3,11,22\n";

}  // namespace

TEST_CASE("without [calibration] and [units] the numbers are the readings",
          "[frames][calibration]") {
  const Read all = read_frames(scene_with(""), four_frames);
  CHECK(all.frames == std::vector<Numbers>{{1, 2}, {3, 6}, {10, 20}, {11, 22}});
  CHECK_FALSE(all.calibration);
}

TEST_CASE("units and calibration are applied to every frame", "[frames][calibration]") {
  CHECK(read_frames(scene_with("[units]\nstress = \"kPa\"\n"), four_frames).frames.at(1) ==
        Numbers{3000, 6000});
  const Read all = read_frames(
      scene_with("[units]\nstress = \"kPa\"\n[calibration]\ngain = [0.5, -0.5]\nbaseline = 1\n"),
      four_frames);
  CHECK(all.frames.at(0) == Numbers{0, -500});
  CHECK(all.frames.at(3) == Numbers{5000, -10500});
  CHECK(all.times == std::vector<std::string>{"0", "1", "2", "3"});
}

TEST_CASE("the mean of frames is the baseline of all, theirs too", "[frames][calibration]") {
  const Scene scene = scene_with("[calibration]\ngain = 2\nbaseline_frames = [0, 1]\n");
  const Read all = read_frames(scene, four_frames);
  CHECK(all.error.empty());
  CHECK(all.frames == std::vector<Numbers>{{-2, -4}, {2, 4}, {16, 32}, {18, 36}});
  CHECK(all.times == std::vector<std::string>{"0", "1", "2", "3"});
  REQUIRE(all.calibration);
  CHECK(all.calibration->baseline == Numbers{2, 4});
  CHECK_FALSE(all.calibration->baseline_frames);

  const Scene later = scene_with("[calibration]\nbaseline_frames = [1, 1]\n");
  CHECK(read_frames(later, four_frames).frames ==
        std::vector<Numbers>{{-2, -4}, {0, 0}, {7, 14}, {8, 16}});
}

TEST_CASE("frames that cannot tell the baseline are refused", "[frames][calibration]") {
  const Scene scene = scene_with("[calibration]\nbaseline_frames = [0, 4]\n");
  CHECK_THAT(read_frames(scene, four_frames).error, ContainsSubstring("ends after 4 frames"));
  const Scene one = scene_with("[calibration]\nbaseline_frames = [0, 1]\n");
  const Read missing = read_frames(one, "stress_x_0,stress_x_1\n1,NaN\n3,NaN\n5,6\n", true);
  CHECK_THAT(missing.error, ContainsSubstring("has no 'stress_x_1' in any frame"));
}

TEST_CASE("what is missing stays missing, and is no part of the baseline",
          "[frames][calibration]") {
  const Scene scene = scene_with("[calibration]\nbaseline_frames = [0, 1]\n");
  const Read all = read_frames(scene, "stress_x_0,stress_x_1\n1,NaN\n3,6\n5,7\n", true);
  REQUIRE(all.frames.size() == 3);
  CHECK(std::isnan(all.frames[0][1]));
  CHECK(all.frames[0][0] == -1.0);
  CHECK(all.frames[2] == Numbers{3, 1});
}

TEST_CASE("a unit in the header is converted to the scene's", "[frames][units]") {
  const std::string rows = "0,1,2\n1,3,6\n";
  const auto read = [&](const std::string& unit, const std::string& more) {
    return read_frames(scene_with(more),
                       "t,stress_x_0 [" + unit + "],stress_x_1 [" + unit + "]\n" + rows);
  };
  const auto said = [&](const std::string& unit, const std::string& more) {
    try {
      (void)read(unit, more);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("was read");
  };
  // The same pressures, whatever the scene's unit and the header's are.
  for (const char* scene : {"Pa", "kPa", "MPa", "psi", "mmHg", "kgf/cm^2"})
    for (const auto& [unit, size] : std::vector<std::pair<std::string, double>>{
             {"Pa", 1.0}, {"kPa", 1e3}, {"N/cm2", 1e4}, {"mmHg", 133.322387415}}) {
      CAPTURE(scene, unit);
      const Read all = read(unit, std::string("[units]\nstress = \"") + scene + "\"\n");
      REQUIRE(all.frames.size() == 2);
      CHECK_THAT(all.frames[1][1], WithinRel(6.0 * size, 1e-14));
    }
  // A row of units says the same as units in the names.
  CHECK(
      read_frames(scene_with("[units]\n"), "t,stress_x_0,stress_x_1\ns,kPa,kPa\n" + rows).frames ==
      read("kPa", "[units]\n").frames);
  // Without [units] nobody knows what the scene's numbers are in.
  CHECK(read("kPa", "").frames == std::vector<Numbers>{{1, 2}, {3, 6}});
  // Another dimension is refused, but for raw numbers, which the gain makes readings of.
  for (const char* unit : {"N", "mm", "V", "counts"}) {
    CAPTURE(unit);
    CHECK_THAT(said(unit, "[units]\n"),
               StartsWith("<stdin>:1:3") && ContainsSubstring("calibration"));
    CHECK(read(unit, "[units]\n[calibration]\ngain = 62.5\n").frames.size() == 2);
  }
  // A gain near 1 corrects readings, one that is the conversion does it; else they contradict.
  const std::string kilopascal = "[units]\nstress = \"kPa\"\n[calibration]\ngain = ";
  CHECK_THAT(read("Pa", kilopascal + "1.25").frames.at(0)[0], WithinRel(1.25, 1e-14));
  CHECK_THAT(read("Pa", kilopascal + "1.25e-3").frames.at(0)[0], WithinRel(1.25, 1e-14));
  CHECK_THAT(said("Pa", kilopascal + "40"), ContainsSubstring("calibration.gain"));
}

TEST_CASE("codes for missing values are gaps", "[frames][calibration]") {
  const std::string calibration =
      GENERATE("", "gain = 0.5\nbaseline = 3\n", "baseline_frames = [0, 2]\n");
  const Scene stated = scene_with("[calibration]\n" + calibration + "missing = [65535, -1]\n");
  const Scene plain = scene_with("[calibration]\n" + calibration);
  const std::string head = "t,stress_x_0,stress_x_1\n";
  const Read codes = read_frames(stated, head + "0,1,65535\n1,-1,-1\n2,10,20\n3,7,-1\n", true);
  const Read gaps = read_frames(plain, head + "0,1,\n1,,\n2,10,20\n3,7,\n", true);
  REQUIRE(codes.frames.size() == 4);
  REQUIRE(gaps.frames.size() == 4);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 2; ++i)
      CHECK((codes.frames[k][i] == gaps.frames[k][i] ||
             (std::isnan(codes.frames[k][i]) && std::isnan(gaps.frames[k][i]))));
  // Where gaps are refused, so are they, at the same line.
  CHECK_THAT(read_frames(stated, head + "0,1,2\n1,3,65535\n2,4,4\n").error,
             StartsWith("<stdin>:3") && ContainsSubstring("missing"));
  // Of a dead taxel nothing is looked at.
  const Scene dead = scene_with("[calibration]\nmissing = [0, -1]\n[dead_taxels]\nindices = [1]\n");
  CHECK(read_frames(dead, "stress_x_0,stress_x_1\n9,-1\n").frames == std::vector<Numbers>{{9, 0}});
}

TEST_CASE("a dead taxel reads zero, whatever its calibration", "[frames][calibration]") {
  const Scene scene =
      scene_with("[calibration]\nbaseline = 7\noffset = 3\n[dead_taxels]\nindices = [1]\n");
  CHECK(read_frames(scene, "stress_x_0,stress_x_1\n9,broken\n").frames ==
        std::vector<Numbers>{{5, 0}});
}

TEST_CASE("a frame that was kept for the baseline is named by its number",
          "[frames][calibration]") {
  const Scene scene = scene_with("[calibration]\nbaseline_frames = [0, 1]\n");
  std::istringstream in(four_frames);
  ReadingsFile file("-", scene, &in);
  Numbers frame(2);
  const auto refusal = [&] {
    try {
      file.source().refuse("is odd", "");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  REQUIRE(file.source().next(frame));
  REQUIRE(file.source().next(frame));
  CHECK_THAT(refusal(), ContainsSubstring("frame 1: is odd"));
  REQUIRE(file.source().next(frame));
  CHECK_THAT(refusal(), ContainsSubstring("<stdin>:4"));
}
