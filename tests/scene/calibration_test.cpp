// [calibration]: what the numbers of a recording mean.
#include "tactile_net/sensing/calibration.hpp"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/scene/refusal.hpp"

using namespace tactile_net;

namespace {

/// Six readings: stress_x_0 ... stress_x_2, strain_x_0 ...
const std::string line_sensor =
    "[sensor]\ncount = 3\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\", \"strain_x\"]\n"
    "[material]\nyoungs_modulus = 1\npoisson_ratio = 0.4\n"
    "[noise]\nrms = { stress_x = 1.0, strain_x = 1.0 }\n";
const std::string in_kilopascals = "[units]\nstress = \"kPa\"\n";

Calibration calibration_of(const std::string& more, const std::string& file = "scene.toml") {
  return parse_scene(line_sensor + more, file).calibration.value();
}

std::string line_refusal(const std::string& more, const std::string& file = "scene.toml") {
  return test::refusal(line_sensor + more, file);
}

using Numbers = std::vector<double>;

/// A folder that is gone when the test ends.
struct Folder {
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "calibration-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder");
    path = name;
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string scene() const { return (path / "scene.toml").string(); }
  std::filesystem::path path;
};

}  // namespace

TEST_CASE("a calibration and its inverse undo one another", "[calibration]") {
  const Calibration calibration{
      .gain = {0.25, -2.0, 1e-6}, .baseline = {512.0, 0.0, -7.5}, .offset = {0.0, 3.0, 1e-3}};
  Numbers numbers = {600.0, 4.0, std::nan("")};
  calibrate(calibration, numbers);
  CHECK(numbers[0] == 22.0);
  CHECK(numbers[1] == -5.0);
  CHECK(std::isnan(numbers[2]));
  uncalibrate(calibration, numbers);
  CHECK(numbers[0] == 600.0);
  CHECK(numbers[1] == 4.0);
  CHECK(std::isnan(numbers[2]));
}

TEST_CASE("a calibration needs all of its numbers", "[calibration]") {
  const Calibration good{.gain = {1.0, 1.0}, .baseline = {0.0, 0.0}, .offset = {0.0, 0.0}};
  CHECK_NOTHROW(check(good, 2));
  CHECK_THROWS_AS(check(good, 3), std::invalid_argument);
  for (const auto values : {&Calibration::gain, &Calibration::baseline, &Calibration::offset})
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      Calibration changed = good;
      (changed.*values)[1] = bad;
      CHECK_THROWS_AS(check(changed, 2), std::invalid_argument);
    }
  Calibration dead = good;
  dead.gain[0] = 0.0;
  CHECK_THROWS_WITH(check(dead, 2), ContainsSubstring("a gain must not be 0"));
}

TEST_CASE("one number, one for each quantity and one for each reading", "[calibration]") {
  CHECK(calibration_of("[calibration]\ngain = 0.5\n").gain == Numbers(6, 0.5));
  CHECK(calibration_of("[calibration]\ngain = { stress_x = 2, strain_x = 1e-6 }\n").gain ==
        Numbers{2, 2, 2, 1e-6, 1e-6, 1e-6});
  const Calibration listed = calibration_of(
      "[calibration]\ngain = [1, 2, 3, 4, 5, -6]\nbaseline = [6, 5, 4, 3, 2, 1]\noffset = 0.25\n");
  CHECK(listed.gain == Numbers{1, 2, 3, 4, 5, -6});
  CHECK(listed.baseline == Numbers{6, 5, 4, 3, 2, 1});
  CHECK(listed.offset == Numbers(6, 0.25));
  const Calibration nothing = calibration_of("[calibration]\n");
  CHECK(nothing.gain == Numbers(6, 1.0));
  CHECK(nothing.baseline == Numbers(6, 0.0));
}

TEST_CASE("gain and offset are in the unit of the reading, the baseline is not", "[calibration]") {
  const Calibration calibration =
      calibration_of(in_kilopascals + "[calibration]\ngain = 0.5\nbaseline = 512\noffset = 2.0\n");
  CHECK(calibration.gain == Numbers{500, 500, 500, 0.5, 0.5, 0.5});
  CHECK(calibration.baseline == Numbers(6, 512.0));
  CHECK(calibration.offset == Numbers{2000, 2000, 2000, 2, 2, 2});
  // Without a table the file's kPa are still to become Pa.
  CHECK(calibration_of(in_kilopascals).gain == Numbers{1000, 1000, 1000, 1, 1, 1});
}

TEST_CASE("codes for missing values are raw numbers, and become none", "[calibration]") {
  Calibration calibration = calibration_of(
      in_kilopascals + "[calibration]\ngain = 0.5\nbaseline = 512\nmissing = [65535, -1]\n");
  CHECK(calibration.missing == Numbers{65535, -1});
  Numbers numbers{65535, 513, -1, 512, 65534, -1};
  calibrate(calibration, numbers);
  CHECK(std::isnan(numbers[0]));
  CHECK(std::isnan(numbers[2]));
  CHECK(std::isnan(numbers[5]));
  calibration.missing.clear();
  Numbers others{513, 512, 65534};
  calibrate({.gain = {500, 500, 0.5}, .baseline = Numbers(3, 512.0), .offset = Numbers(3, 0.0)},
            others);
  CHECK(others == Numbers{numbers[1], numbers[3], numbers[4]});
}

TEST_CASE("a calibration that does not fit is refused at its place", "[calibration]") {
  const auto [more, words] = GENERATE(table<std::string, std::string>(
      {{"gain = 0", "calibration.gain must not be 0 (got 0)"},
       {"gain = [1, 1, 0, 1, 1, 1]", "calibration.gain must not be 0"},
       {"gain = [1, 2, 3]", "must have one value per reading, channel after channel: 6 (got 3)"},
       {"gain = { stress_x = 1 }", "calibration.gain.strain_x is missing"},
       {"gain = { stress_x = 1, strain_x = 1, shear_xy = 1 }", "unknown key"},
       {"gain = \"0.5\"", "calibration.gain must be a number"},
       {"baseline = nan", "calibration.baseline must be a finite number"},
       {"gian = 1", "did you mean gain?"},
       {"gains = 0", "calibration.gains must not be 0"},
       {"gains = 2\ngain = 1", "calibration.gain exclude each other"},
       {"missing = 65535", "calibration.missing must be"},
       {"missing = [\"x\"]", "must be a number"},
       {"missing = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17]", "at most 16"},
       {"baseline_frames = [0]", "must be two frame numbers"},
       {"baseline_frames = [9, 0]", "must begin with the earlier frame"},
       {"baseline_frames = [0, 1398101]", "calibration.baseline_frames must be from 0 to 1398100"},
       {"baseline_frames = [-1, 5]", "calibration.baseline_frames must be from 0"},
       {"baseline_frames = [0, 1]\nbaseline = 1", "exclude each other"},
       {"file = 3", "calibration.file must be text"},
       {"file = \"\"", "must name a file"},
       {"file = \"nowhere.csv\"", "no such file"}}));
  CHECK_THAT(line_refusal("[calibration]\n" + more + "\n"),
             StartsWith("scene.toml:12:") && ContainsSubstring(words));
}

TEST_CASE("the first frames may tell the baseline", "[calibration]") {
  const Calibration calibration = calibration_of("[calibration]\nbaseline_frames = [2, 99]\n");
  REQUIRE(calibration.baseline_frames);
  CHECK(calibration.baseline_frames->first == 2);
  CHECK(calibration.baseline_frames->last == 99);
  CHECK(calibration.baseline == Numbers(6, 0.0));
}

TEST_CASE("a file beside the scene has a row per reading", "[calibration]") {
  const Folder folder;
  std::filesystem::create_directory(folder.path / "below");
  const std::string rows =
      "stress_x_0,1.5,10\nstress_x_1,2.5,20\nstress_x_2,3.5,30\n"
      "strain_x_0,1e-6,40\nstrain_x_1,2e-6,50\nstrain_x_2,3e-6,60\n";
  folder.write("c.csv", "\xEF\xBB\xBF# by hand\r\nreading, gain ,baseline\n\n" + rows);
  folder.write("below/c.csv", "baseline\n1\n2\n3\n4\n5\n6\n");
  const Calibration calibration = calibration_of(
      in_kilopascals + "[calibration]\nfile = \"c.csv\"\noffset = 1\n", folder.scene());
  CHECK(calibration.gain == Numbers{1500, 2500, 3500, 1e-6, 2e-6, 3e-6});
  CHECK(calibration.baseline == Numbers{10, 20, 30, 40, 50, 60});
  CHECK(calibration.offset == Numbers{1000, 1000, 1000, 1, 1, 1});
  CHECK(calibration_of("[calibration]\nfile = \"below/c.csv\"\n", folder.scene()).baseline ==
        Numbers{1, 2, 3, 4, 5, 6});
  CHECK_THAT(line_refusal("[calibration]\nfile = \"c.csv\"\ngain = 1\n", folder.scene()),
             ContainsSubstring("calibration.gain is given in calibration.file too"));
  CHECK_THAT(
      line_refusal("[calibration]\nfile = \"c.csv\"\nbaseline_frames = [0, 9]\n", folder.scene()),
      ContainsSubstring("exclude each other"));
}

TEST_CASE("what is wrong in a calibration's file is said by its line, and not quoted",
          "[calibration]") {
  const Folder folder;
  const auto [text, words] = GENERATE(table<std::string, std::string>(
      {{"secret\n1\n", "line 1: a column has another name than reading, gain, baseline, offset"},
       {"gain,gain\n", "line 1: a column stands there twice"},
       {"gain\n1\n2\n", "it has 2 rows, the array 6 readings"},
       {"gain\n1\n1\n1\n1\n1\n1\n1\n", "it has 7 rows, the array 6 readings"},
       {"gain\n1\nsecret\n", "line 3: gain is not a finite number"},
       {"gain\n1\ninf\n", "line 3: gain is not a finite number"},
       {"gain,baseline\n1\n", "line 2: it has 1 fields, the header 2"},
       {"gain\n1\n1\n0\n1\n1\n1\n", "whose gain of reading 2 must not be 0"},
       {"reading,gain\nstress_x_1,1\n", "line 2: this row belongs to stress_x_0"},
       {"", "it has 0 rows"}}));
  folder.write("c.csv", text);
  const std::string error = line_refusal("[calibration]\nfile = \"c.csv\"\n", folder.scene());
  CHECK_THAT(error, ContainsSubstring("scene.toml:12:8: error: calibration.file names a file") &&
                        ContainsSubstring(words));
  CHECK(error.find("secret") == std::string::npos);
}

TEST_CASE("a scene names a calibration beside it or below alone", "[calibration]") {
  const Folder folder;
  std::filesystem::create_directory(folder.path / "inner");
  folder.write("c.csv", "baseline\n1\n2\n3\n4\n5\n6\n");
  std::filesystem::create_symlink(folder.path / "c.csv", folder.path / "inner" / "link.csv");
  const std::string inner = (folder.path / "inner" / "scene.toml").string();
  for (const std::string& file :
       {std::string("../c.csv"), std::string("link.csv"), (folder.path / "c.csv").string(),
        std::string("/etc/passwd"), std::string("/dev/zero")}) {
    CAPTURE(file);
    CHECK_THAT(line_refusal("[calibration]\nfile = \"" + file + "\"\n", inner),
               ContainsSubstring("must name a file beside the scene's or below its folder"));
  }
  CHECK_THAT(line_refusal("[calibration]\nfile = \".\"\n", inner),
             ContainsSubstring("is a folder"));
}

namespace {

/// Two rows, three columns, two quantities: stress_x_0_0 ... stress_x_1_2, displacement_y_0_0 ...
const std::string skin_sensor =
    "[sensor]\nrows = 2\ncolumns = 3\npitch = 0.5\ndepth = 1.5\n"
    "reads = [\"stress_x\", \"displacement_y\"]\n"
    "[material]\nyoungs_modulus = 1\npoisson_ratio = 0.4\n"
    "[noise]\nrms = { stress_x = 1.0, displacement_y = 1.0 }\n";

SkinScene calibrated_skin(const std::string& more, const std::string& file = "scene.toml") {
  return std::get<SkinScene>(parse_any_scene(skin_sensor + more, file));
}

std::string skin_refusal(const std::string& more, const std::string& file = "scene.toml") {
  return test::refusal_of([&] { return parse_any_scene(skin_sensor + more, file); });
}

std::vector<double> twelve(double stress, double displacement) {
  std::vector<double> all(6, stress);
  all.insert(all.end(), 6, displacement);
  return all;
}

}  // namespace

TEST_CASE("a skin has the calibration of a line, a number a taxel and quantity",
          "[calibration][skin]") {
  CHECK_FALSE(calibrated_skin("").calibration);
  const Calibration units =
      calibrated_skin("[units]\nstress = \"kPa\"\nlength = \"mm\"\n").calibration.value();
  CHECK(units.gain == twelve(1000.0, 1e-3));
  const Calibration each =
      calibrated_skin(
          "[calibration]\ngain = { stress_x = 2, displacement_y = 1e-6 }\noffset = 0.25\n")
          .calibration.value();
  CHECK(each.gain == twelve(2.0, 1e-6));
  CHECK(each.offset == Numbers(12, 0.25));
  const Calibration listed =
      calibrated_skin(
          "[calibration]\ngains = [1, 2, 4, 1, 2, 4, 0.5, 0.25, 1, 1, 1, -1]\noffsets = "
          "[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]\n")
          .calibration.value();
  CHECK(listed.gain == Numbers{1, 0.5, 0.25, 1, 0.5, 0.25, 2, 4, 1, 1, 1, -1});
  CHECK(listed.baseline == Numbers{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  CHECK(calibrated_skin("[calibration]\nbaseline_frames = [2, 99]\n")
            .calibration->baseline_frames->last == 99);
}

TEST_CASE("a skin's calibration that does not fit is refused with both counts",
          "[calibration][skin]") {
  const auto [more, wanted] = GENERATE(table<std::string, std::string>(
      {{"gain = [1, 2, 3]", "one value per reading, channel after channel: 12 (got 3)"},
       {"gain = { stress_x = 1 }", "calibration.gain.displacement_y is missing"},
       {"gain = { stress_x = 1, displacement_y = 1, shear_xy = 1 }", "unknown key"},
       {"gain = 0", "calibration.gain must not be 0"},
       {"gains = 2\noffset = 1", "calibration.offset exclude each other"},
       {"gian = 1", "unknown key \"calibration.gian\""}}));
  CAPTURE(more);
  CHECK_THAT(skin_refusal("[calibration]\n" + more + "\n"), ContainsSubstring(wanted));
}

TEST_CASE("a skin's file of calibration names its readings by row and column",
          "[calibration][skin]") {
  const Folder folder;
  std::string file = "reading,gain\n";
  for (const std::string quantity : {"stress_x", "displacement_y"})
    for (const std::string place : {"0_0", "0_1", "0_2", "1_0", "1_1", "1_2"})
      file += quantity + "_" + place + (quantity == "stress_x" ? ",2\n" : ",3\n");
  folder.write("c.csv", file);
  const std::string table = "[calibration]\nfile = \"c.csv\"\n";
  CHECK(calibrated_skin(table, folder.scene()).calibration->gain == twelve(2.0, 3.0));
  folder.write("c.csv", "gain\n1\n1\n");
  CHECK_THAT(skin_refusal(table, folder.scene()),
             ContainsSubstring("it has 2 rows, the array 12 readings"));
  folder.write(
      "c.csv", "gain\n" + [] {
        std::string rows;
        for (int i = 0; i < 14; ++i) rows += "1\n";
        return rows;
      }());
  CHECK_THAT(skin_refusal(table, folder.scene()),
             ContainsSubstring("it has 14 rows, the array 12 readings"));
  folder.write("c.csv", "reading,gain\nstress_x_0_1,1\n");
  CHECK_THAT(skin_refusal(table, folder.scene()),
             ContainsSubstring("line 2: this row belongs to stress_x_0_0"));
}
