// Scenes of skins: what a good one says, and for every rule one change that breaks it, with
// exactly one message, at its place.
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/scene_template.hpp"
#include "tests/catch.hpp"
#include "tests/scene/refusal.hpp"
#include "tests/scene/single_mistake.hpp"

using namespace tactile_net;

namespace {

constexpr std::string_view good_skin = R"([units]
length = "mm"
modulus = "MPa"
stress = "kPa"
force = "N"
[sensor]
rows = 3
columns = 4
pitch = [2.0, 1.5]
depth = 2.0
reads = ["stress_x", "shear_xy", "shear_xz"]
[material]
youngs_modulus = 0.25
poisson_ratio = 0.48
layer = { thickness = 4.0, base = "bonded" }
[time]
rate = 10.0
frames = 3
[[contact]]
shape = "ellipsoid"
place = [1.0, -0.5]
radii = [2.0, 1.0]
angle = 30.0
friction = 0.4
direction = 90.0
stick = 0.5
torsion = 0.2
trajectory = [{ t = 0.0, force = 0.5 }, { t = 0.2, place = [1.5, 0.5], force = 1.5 }]
[[contact]]
shape = "tractions"
spacing = 0.5
normal = [[0.0, 1.0], [2.0, 3.0]]
[noise]
rms = { stress_x = 0.1, shear_xy = 0.05, shear_xz = 0.05 }
[dead_taxels]
indices = [5]
[forward]
model = "exact"
[reconstruct]
methods = ["tikhonov"]
alpha = "gml"
friction_limit = 0.8
spacing = 1.0
margin = 2.0
)";

SkinScene parsed_skin(const std::string& toml) {
  return std::get<SkinScene>(parse_any_scene(toml, "skin.toml"));
}

std::vector<Diagnostic> skin_problems(const std::string& toml) {
  return test::diagnostics_of([&] { return parse_any_scene(toml, "skin.toml"); });
}

void check_skins(const std::vector<test::Mistake>& mistakes) {
  test::check_each(good_skin, skin_problems, mistakes);
}

/// A file of taxels in a folder of its own, and a scene that names it.
class SkinFolder {
 public:
  explicit SkinFolder(const std::string& csv) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "palm.csv") << csv;
    std::ofstream(folder_ / "palm.toml")
        << "[sensor]\ntaxels = \"palm.csv\"\n[material]\nyoungs_modulus = 1.0\n"
           "poisson_ratio = 0.45\nlayer = { thickness = 4.0, base = \"bonded\" }\n";
  }
  SkinFolder(const SkinFolder&) = delete;
  SkinFolder& operator=(const SkinFolder&) = delete;
  ~SkinFolder() { std::filesystem::remove_all(folder_); }

  [[nodiscard]] AnyScene scene() const { return read_any_scene(folder_ / "palm.toml"); }
  [[nodiscard]] std::string problem() const {
    try {
      (void)scene();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / "skin_scene_test";
};

}  // namespace

TEST_CASE("a skin's scene is read in SI, its contacts as they are at the last frame", "[scene]") {
  const SkinScene scene = parsed_skin(std::string(good_skin));
  CHECK(scene.sensor.rows == 3);
  CHECK(scene.sensor.columns == 4);
  CHECK(scene.sensor.pitch_y == 2e-3);
  CHECK(scene.sensor.pitch_z == 1.5e-3);
  CHECK(scene.material.youngs_modulus == 0.25e6);
  CHECK(scene.frame == 2);
  const auto& contact = std::get<SkinContact>(scene.contacts.at(0));
  CHECK(contact.shape == SkinShape::ellipsoid);
  CHECK(contact.y == 1.5e-3);
  CHECK(contact.force == 1.5);
  CHECK(contact.second_radius == 1e-3);
  CHECK_THAT(contact.direction, WithinRel(0.5 * std::numbers::pi, 1e-15));
  CHECK_THAT(contact.torsion, WithinRel(0.2e-3, 1e-15));
  CHECK(std::get<SkinContact>(at_frame(scene, 1).contacts[0]).force == 1.0);
  CHECK(std::get<SampledPatch>(scene.contacts.at(1)).normal == std::vector{0.0, 1e3, 2e3, 3e3});
  CHECK(scene.noise->weights_rows);
  CHECK(scene.noise->rms.at(Quantity::shear_xy) == 50.0);
  CHECK(scene.reconstruct.alpha_rule == AlphaRule::gml);
  CHECK(components(scene) == 3);
  CHECK_THROWS_AS(at_frame(scene, 3), std::invalid_argument);
}

TEST_CASE("a skin is told from a line by rows, columns or a column z", "[scene]") {
  const std::string rest =
      "depth = 1.0\nreads = [\"stress_x\"]\n[material]\nyoungs_modulus = 1.0\npoisson_ratio = "
      "0.4\n";
  CHECK(std::holds_alternative<Scene>(
      parse_any_scene("[sensor]\ncount = 4\npitch = 1.0\n" + rest, "a.toml")));
  CHECK(std::holds_alternative<SkinScene>(
      parse_any_scene("[sensor]\nrows = 1\ncolumns = 1\npitch = 1.0\n" + rest, "a.toml")));
  CHECK(std::holds_alternative<Scene>(
      SkinFolder("y,depth,reads\n0,1,stress_x\n1,1,stress_x\n").scene()));
  CHECK(std::holds_alternative<SkinScene>(
      SkinFolder("name,y [m],z [m],depth,reads\na,0,0,1,stress_x shear_xz\n").scene()));
}

TEST_CASE("who knows lines alone says so of a skin, once", "[scene]") {
  try {
    (void)parse_scene(good_skin, "skin.toml");
    FAIL("a skin is taken for a line");
  } catch (const InputError& error) {
    REQUIRE(error.diagnostics().size() == 1);
    CHECK(error.diagnostics()[0].line == 6);
    CHECK_THAT(error.diagnostics()[0].message, ContainsSubstring("describes a skin"));
  }
}

TEST_CASE("a study's scene may be a skin", "[scene]") {
  const SceneTemplate base{std::string(good_skin), "skin.toml"};
  CHECK(std::holds_alternative<SkinScene>(base.with({})));
}

TEST_CASE("a skin whose file of taxels is not in order is no line", "[scene]") {
  // The header names no z, or another: what else the scene says tells.
  const std::string toml =
      "[units]\nlength = \"mm\"\nstress = \"kPa\"\nforce = \"N\"\n[sensor]\n"
      "taxels = \"nobody.csv\"\nreads = [\"stress_x\"]\ndepth = 1.0\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n";
  for (const char* more : {"",
                           "[[contact]]\nshape = \"sphere\"\nradius = 1.0\nforce = 1.0\n"
                           "place = [0.0, 0.0]\n"}) {
    const auto problems = skin_problems(toml + more);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].line == 6);
    CHECK_THAT(problems[0].message, ContainsSubstring("a file that is not in order"));
    CHECK_THAT(problems[0].hint, ContainsSubstring("name,y,z,depth,reads"));
  }
}

TEST_CASE("what is wrong with a skin's scene is said at its place", "[scene]") {
  CHECK(skin_problems(std::string(good_skin)).empty());
  check_skins({
      {"rows = 3", "rows = 0", "7:8", "must be from 1 to 262144"},
      {"columns = 4", "column = 4", "8:1", "unknown key \"sensor.column\""},
      {"pitch = [2.0, 1.5]", "pitch = [2.0]", "9:9", "must be two numbers"},
      {"pitch = [2.0, 1.5]", "pitch = nan", "9:9", "must be a finite number"},
      {"depth = 2.0", "depth = 5.0", "15:23", "must be at least the sensors' depth"},
      {"\"shear_xz\"]", "\"shear_yx\"]", "11:34", "unknown quantity"},
      {"shape = \"ellipsoid\"", "shape = \"cylnder\"", "20:9", "unknown shape"},
      {"shape = \"ellipsoid\"", "shape = \"cylinder\"", "20:9", "for lines of taxels", "sphere"},
      {"shape = \"ellipsoid\"", "shape = \"wedge\"", "20:9", "for lines of taxels", "cone"},
      {"radii = [2.0, 1.0]", "radii = [2.0, -1.0]", "22:15", "must be > 0"},
      {"stick = 0.5", "stick = 1.0", "26:9", "must be >= 0 and < 1"},
      {"place = [1.5, 0.5]", "place = [15.0, 0.5]", "28:60", "trajectory.place puts the contact"},
      {"radii = [2.0, 1.0]", "", "28:15", "contact.trajectory.radii is missing"},
      {"normal = [[0.0, 1.0], [2.0, 3.0]]", "normal = []", "32:10", "at least one row"},
      {"normal = [[0.0, 1.0], [2.0, 3.0]]", "normal = [1, 2]", "32:10", "must be a list of rows"},
      {"rows = 3", "rows = 200000", "7:8", "makes 800000 taxels, more than 262144"},
      {"t = 0.2,", "t = 0.0,", "28:47", "must be later than the knot before"},
      {"[2.0, 3.0]]", "[2.0]]", "32:23", "as many numbers as the first row"},
      {", shear_xz = 0.05", "", "34:7", "noise.rms.shear_xz is missing"},
      {"indices = [5]", "indices = [12]", "36:12", "must be from 0 to 11"},
      {"indices = [5]", "indices = [5, 5]", "36:15", "names a taxel twice"},
      {"methods = [\"tikhonov\"]", "methods = [\"dft\"]", "40:12", "unknown method of skins"},
      {"methods = [\"tikhonov\"]", "methods = [\"network\"]", "40:12", "asks for a circuit"},
      {"alpha = \"gml\"", "alpha = \"ncp\"", "41:9", "looks for white noise along a line"},
      {"spacing = 1.0\nmargin", "spacing = 1e-300\nmargin", "43:11", "too many cells"},
      {"spacing = 1.0\nmargin", "spacing = 0.012\nmargin", "43:11", "unknown tractions, more than"},
      {"margin = 2.0", "margin = 2.0\nnonnegative = false", "45:15", "which friction_limit does"},
      {"margin = 2.0", "margin = 2.0\noffset = 1", "45:10", "must be true or false"},
      {"margin = 2.0", "margin = 2.0\ntangential_weight = 0", "45:21", "must be > 0 (got 0)"},
      {"margin = 2.0", "margin = 2.0\ntangential_weight = \"evidense\"", "45:21",
       "unknown way to estimate a weight"},
      {"margin = 2.0", "margin = 2.0\nsurface = \"grid\"", "45:11", "has one kind for skins"},
      {"[dead_taxels]", "[network]\nrealization = \"mesh\"\n[dead_taxels]", "36:15",
       "unknown realization"},
      {"[dead_taxels]", "[network]\nspacing = 0.1\n[dead_taxels]", "36:11",
       "is finer than the cells, which lie 0.75 apart"},
  });
}

TEST_CASE("too many cells are refused with what would make fewer", "[scene]") {
  const auto hint = [](std::string_view from, std::string_view to) {
    std::string toml(good_skin);
    toml.replace(toml.find(from), from.size(), to);
    const auto problems = skin_problems(toml);
    CAPTURE(InputError{problems}.what());
    REQUIRE(problems.size() == 1);
    // What is advised makes a scene.
    const std::string& advice = problems[0].hint;
    return advice;
  };
  CHECK_THAT(hint("margin = 2.0", "margin = 1e9"),
             ContainsSubstring("reconstruct.margin is left out: the depth, which makes"));
  CHECK_THAT(hint("spacing = 1.0\nmargin", "spacing = 1e-300\nmargin"),
             ContainsSubstring("reconstruct.spacing is left out"));
  // Half of so small a depth: the depth is named, and a spacing that will do.
  std::string toml(good_skin);
  toml.replace(toml.find("depth = 2.0"), 11, "depth = 1e-6");
  toml.replace(toml.find("spacing = 1.0\nmargin = 2.0\n"), 27, "");
  const auto problems = skin_problems(toml);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].line == 10);
  const std::string& advice = problems[0].hint;
  REQUIRE(advice.starts_with("reconstruct.spacing = "));
  CHECK(skin_problems(toml + advice.substr(12, advice.find(',') - 12) + "\n").empty());
}

TEST_CASE("displacements along a surface that slips are refused with what to do", "[scene]") {
  std::string toml(good_skin);
  toml.replace(toml.find("\"shear_xz\""), 10, "\"displacement_y\"");
  toml.replace(toml.find("\"bonded\""), 8, "\"frictionless\"");
  toml.replace(toml.find("shear_xz = 0.05"), 15, "displacement_y = 0.1");
  const auto problems = skin_problems(toml);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].line == 11);
  CHECK_THAT(problems[0].hint, ContainsSubstring("bonded"));
}

TEST_CASE("a file of taxels that is not in order is said with its line", "[scene]") {
  const auto problem = [](const std::string& csv) { return SkinFolder(csv).problem(); };
  const std::string head = "name,y,z,depth,reads\n";
  CHECK_THAT(problem(head + "a,0,0,1,stress_x\nb,0,0,1,stress_x\n"),
             ContainsSubstring("palm.toml:2:10") &&
                 ContainsSubstring("line 3: the taxel is at the place of that in line 2"));
  CHECK_THAT(problem(head + "a,0,0,1,stress_x\na,1,0,1,stress_x\n"),
             ContainsSubstring("line 3: the name is that of the taxel in line 2 too"));
  CHECK_THAT(problem("name,y,z,depth,reads\na,0,0,1\n"), ContainsSubstring("line 2: it has 4"));
  CHECK_THAT(problem(head + "a,0,nan,1,stress_x\n"),
             ContainsSubstring("line 2: z is not a finite number"));
  CHECK_THAT(problem(head + "a,0,0,-1,stress_x\n"), ContainsSubstring("line 2: depth is not > 0"));
  CHECK_THAT(problem(head + "a,0,0,1,stress\n"), ContainsSubstring("reads names something else"));
  CHECK_THAT(problem(head + "a,0,0,5,stress_x\n"),
             ContainsSubstring("at least the sensors' depth"));
  CHECK_THAT(problem("name,y,z,reads\na,0,0,stress_x\n"),
             ContainsSubstring("there is no column depth"));
}
