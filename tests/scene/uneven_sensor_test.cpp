// [sensor] with taxels that have places of their own.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/scene/refusal.hpp"

using namespace tactile_net;
using test::refusal;

namespace {

const std::string material_table = "[material]\nyoungs_modulus = 1\npoisson_ratio = 0.4\n";

std::string positions(const std::string& list, const std::string& more = "depth = 1.5\n") {
  return "[sensor]\npositions = [" + list + "]\nreads = [\"stress_x\"]\n" + more + material_table;
}

/// A folder of its own with a file of taxels.
class TaxelFile {
 public:
  explicit TaxelFile(const std::string& text)
      : folder_(std::filesystem::temp_directory_path() / ("taxels-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "palm.csv") << text;
  }
  ~TaxelFile() { std::filesystem::remove_all(folder_); }
  TaxelFile(const TaxelFile&) = delete;
  TaxelFile& operator=(const TaxelFile&) = delete;

  /// @param sensor  more lines of [sensor]; @param head  what stands before it
  [[nodiscard]] std::string refusal(const std::string& sensor = {},
                                    const std::string& head = {}) const {
    return test::refusal(scene(sensor, head), (folder_ / "scene.toml").string());
  }
  [[nodiscard]] Scene read(const std::string& sensor = {}, const std::string& head = {}) const {
    return parse_scene(scene(sensor, head), (folder_ / "scene.toml").string());
  }

 private:
  static std::string scene(const std::string& sensor, const std::string& head) {
    return head + "[sensor]\ntaxels = \"palm.csv\"\n" + sensor + material_table;
  }
  std::filesystem::path folder_;
};

}  // namespace

TEST_CASE("positions with one depth, or one for each", "[scene][uneven]") {
  const Scene one = parse_scene(positions("-3, 0.5, 2"), "scene.toml");
  REQUIRE(one.sensor.taxels.size() == 3);
  CHECK(one.sensor.taxels[1].y == 0.5);
  CHECK(one.sensor.taxels[2].depth == 1.5);
  CHECK(one.reconstruct.surface.basis == SurfaceBasis::hats);
  const Scene each =
      parse_scene(positions("-3, 0.5, 0.5", "depth = [1.5, 1.2, 2.0]\n"), "scene.toml");
  CHECK(each.sensor.taxels[1].depth == 1.2);
  CHECK(each.reconstruct.smoothing_length == 1.2);
  const Scene in_millimetres =
      parse_scene("[units]\nlength = \"mm\"\n" + positions("-3, 0.5"), "scene.toml");
  CHECK(in_millimetres.sensor.taxels[0].y == -3e-3);
  CHECK(in_millimetres.sensor.taxels[0].depth == 1.5e-3);
}

TEST_CASE("what is wrong with positions is said where it stands", "[scene][uneven]") {
  CHECK_THAT(refusal(positions("-3, 2, 1")), ContainsSubstring("scene.toml:2:21") &&
                                                 ContainsSubstring("below the taxel before it"));
  CHECK_THAT(refusal(positions("-3, 1, 1")), ContainsSubstring("the place of the taxel before it"));
  CHECK_THAT(refusal(positions("1")), ContainsSubstring("from 2 to 4096 taxels"));
  CHECK_THAT(refusal(positions("1, nan")), ContainsSubstring("must be a finite number"));
  CHECK_THAT(refusal(positions("1, 2", "depth = [1, 2, 3]\n")),
             ContainsSubstring("one for each taxel: 2 (got 3)"));
  CHECK_THAT(refusal(positions("1, 2", "depth = 1\ncount = 2\n")),
             ContainsSubstring("sensor.count"));
  CHECK_THAT(refusal(positions("1, 2", "depth = 1\npitch = 2\n")),
             ContainsSubstring("sensor.pitch"));
  CHECK_THAT(refusal(positions("1, 2", "depths = [1, 2]\n")),
             ContainsSubstring("one for each taxel"));
  CHECK_THAT(refusal(positions("1, 2", "")), ContainsSubstring("sensor.depth"));
  CHECK_THAT(
      refusal(positions("1, 2", "depth = 4\n") + "layer = { thickness = 3, base = \"bonded\" }"),
      ContainsSubstring("must be at least the sensors' depth"));
}

TEST_CASE("what needs even taxels is refused with the reason", "[scene][uneven]") {
  const std::string scene = positions("-3, 0.5, 2");
  const auto equal = ContainsSubstring("equally far apart");
  CHECK_THAT(refusal(scene + "[forward]\nmodel = \"sampled\"\n"), equal);
  CHECK_THAT(refusal(scene + "[reconstruct]\nsurface = \"taxels\"\n"), equal);
  CHECK_THAT(refusal(scene + "[reconstruct]\nmethods = [\"dft\"]\n"), equal);
  CHECK_THAT(refusal(scene + "[[contact]]\nshape = \"tractions\"\nnormal = [0, 1, 0]\n"), equal);
}

TEST_CASE("taxels from a file, each with what it reads", "[scene][uneven]") {
  const TaxelFile file(
      "# a palm\ny,depth,reads\n-2,1.5,stress_x shear_xy\n0,1.2,stress_x\n"
      "\n0,1.5,stress_x\n3,1.5,shear_xy\n");
  const Scene scene = file.read();
  CHECK(reading_names(scene.sensor) == std::vector<std::string>{"stress_x_0", "stress_x_1",
                                                                "stress_x_2", "shear_xy_0",
                                                                "shear_xy_3"});
  CHECK(unknowns(scene) == 2);
  const Scene in_millimetres = file.read("", "[units]\nlength = \"mm\"\n");
  CHECK(in_millimetres.sensor.taxels[3].y == 3e-3);
}

TEST_CASE("a file of taxels is the same with quotes around its fields", "[scene][uneven]") {
  const auto names_of_file = [](const std::string& text) {
    const Scene scene = TaxelFile(text).read();
    std::vector<std::string> all = reading_names(scene.sensor);
    for (const Taxel& taxel : scene.sensor.taxels) all.push_back(std::to_string(taxel.y));
    return all;
  };
  const auto plain = names_of_file("y,depth,reads\n-2.5,1.5,stress_x shear_xy\n3,1.5,stress_x\n");
  CHECK(names_of_file("\"y\",\"depth\",\"reads\"\n-2.5,\"1.5\",\"stress_x shear_xy\"\n"
                      "\"3\",1.5,\"stress_x\"\n") == plain);
  CHECK(names_of_file("\"y\";\"depth\";\"reads\"\n\"-2,5\";1,5;\"stress_x shear_xy\"\n"
                      "3;1,5;stress_x\n") == plain);
}

TEST_CASE("the scene says what the file leaves out", "[scene][uneven]") {
  const TaxelFile file("y [mm]\n-2\n0\n3\n");
  const Scene scene =
      file.read("depth = 1.5\nreads = [\"strain_x\"]\n", "[units]\nlength = \"mm\"\n");
  CHECK(scene.sensor.taxels[2].depth == 1.5e-3);
  CHECK(scene.sensor.reads == std::vector{Quantity::strain_x});
  CHECK_THAT(file.refusal("reads = [\"strain_x\"]\n", "[units]\nlength = \"mm\"\n"),
             ContainsSubstring("no column depth"));
  CHECK_THAT(file.refusal("depth = 1.5\n", "[units]\nlength = \"mm\"\n"),
             ContainsSubstring("no column reads"));
  CHECK_THAT(file.refusal("depth = 1.5\nreads = [\"strain_x\"]\n"),
             ContainsSubstring("another unit than the scene's, m"));
}

TEST_CASE("taxels may have a width, one for all or each its own", "[scene][uneven]") {
  const std::string even = "[sensor]\ncount = 5\npitch = 1\ndepth = 1.5\nreads = [\"stress_x\"]\n";
  CHECK(parse_scene(even + "width = 0.8\n" + material_table, "scene.toml").sensor.width == 0.8);
  CHECK(sites(parse_scene(even + "width = 0.8\n" + material_table, "s").sensor)[3].width == 0.8);
  const Scene listed =
      parse_scene(positions("-2, 0, 3", "depth = 1.5\nwidth = [0, 1.0, 2]\n"), "scene.toml");
  CHECK(listed.sensor.taxels[1].width == 1.0);
  CHECK(listed.sensor.taxels[2].width == 2.0);
  const TaxelFile file("y,depth,reads,width\n-2,1.5,stress_x,0.5\n0,1.2,stress_x,0\n");
  CHECK(file.read().sensor.taxels[0].width == 0.5);
  const TaxelFile silent("y,depth,reads\n-2,1.5,stress_x\n0,1.2,stress_x\n");
  CHECK(silent.read("width = 0.7\n").sensor.taxels[1].width == 0.7);

  CHECK_THAT(refusal(even + "width = -1\n" + material_table),
             ContainsSubstring("sensor.width must be >= 0"));
  CHECK_THAT(refusal(even + "width = 1e6\n" + material_table),
             ContainsSubstring("at most 10000 depths"));
  CHECK_THAT(refusal(positions("-2, 0, 3", "depth = 1.5\nwidth = [1, 2]\n")),
             ContainsSubstring("one for each taxel: 3 (got 2)"));
  CHECK_THAT(refusal(positions("-2, 0, 3", "depth = 1.5\nwidth = 1e6\n")),
             ContainsSubstring("at most 10000 depths"));
  CHECK_THAT(TaxelFile("y,depth,reads,width\n-2,1.5,stress_x,-1\n0,1,stress_x,0\n").refusal(),
             ContainsSubstring("line 2: width is below 0"));
}

TEST_CASE("a file of taxels that is not in order is refused with its line", "[scene][uneven]") {
  const auto said = [](const std::string& text) { return TaxelFile(text).refusal(); };
  CHECK_THAT(said("y,depth,reads\n0,1,stress_x\n-1,1,stress_x\n"),
             ContainsSubstring("line 3: y is below"));
  CHECK_THAT(said("y,depth,reads\n0,1,stress_x\n0,1,stress_x\n"),
             ContainsSubstring("line 3: the taxel is at the place of that in line 2") &&
                 ContainsSubstring("and reads the same, stress_x"));
  CHECK_THAT(said("y,depth,reads\n0,1,stress_x\n1,nan,stress_x\n"),
             ContainsSubstring("line 3: depth is not a finite number"));
  CHECK_THAT(said("y,depth,reads\n0,1,stress_x\n1,0,stress_x\n"),
             ContainsSubstring("line 3: depth is not > 0"));
  CHECK_THAT(said("y,depth,reads\n0,1,stress_x\n1,1,pressure\n"),
             ContainsSubstring("line 3: reads names something else"));
  CHECK_THAT(said("y,depth,reads\n0,1,stress_x\n1,1,stress_z\n"),  // a skin reads it
             ContainsSubstring("line 3: reads names something else"));
  CHECK_THAT(said("y,depth,reads\n0,1,stress_x\n1,1\n"),
             ContainsSubstring("line 3: it has 2 fields"));
  CHECK_THAT(said("x_mm,z_mm,type\n0,1,stress_x\n"),
             ContainsSubstring("line 1: a column has another name than y, depth, reads"));
  CHECK_THAT(said("y,depth,reads\n0,1,stress_x\n"), ContainsSubstring("1 taxels: from 2"));
  CHECK_THAT(said(""), ContainsSubstring("it has 0 rows"));
  CHECK_THAT(refusal("[sensor]\ntaxels = \"../palm.csv\"\n" + material_table),
             ContainsSubstring("beside the scene's"));
}
