#include "tactile_net/sweep/study.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <variant>

#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/sweep/row.hpp"
#include "tests/catch.hpp"
#include "tests/replaced.hpp"
#include "tests/sweep/small_study.hpp"

using namespace tactile_net;
using test::grid_study;
using test::StudyFolder;

namespace {

/// The seed of every point, by its values.
std::map<std::string, std::uint64_t> seeds(const sweep::Study& study) {
  std::map<std::string, std::uint64_t> all;
  for (std::size_t i = 0; i < study.points(); ++i) {
    const sweep::Point point = study.point(i);
    std::string name;
    for (const AxisValue& value : point.values) name += value.plain + ' ';
    all[name] = point.seed;
  }
  return all;
}

/// Fails, and says where its folder was.
struct Failing final : Simulator {
  std::string folder;
  explicit Failing(std::string name) : folder(std::move(name)) {}
  Simulation run(const std::string&) override {
    throw SimulatorError(SimulatorError::Cause::failed,
                         "ngspice: 3 N/mm and 1/s in " + folder +
                             "/deck.cir line 4\n  deck and log: " + folder + "-kept",
                         {});
  }
};

/// The scene of a line array at a point.
Scene line(const sweep::Study& study, const sweep::Point& point) {
  return std::get<Scene>(study.scene(point));
}

double number(const AxisValue& value) {
  double result = NAN;
  REQUIRE(read_number(value.plain, result));
  return result;
}

std::string refusal(const StudyFolder& folder, const std::string& text) {
  try {
    (void)folder.study(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("points have one order: the last axis varies fastest, repeats before all", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  REQUIRE(study.points() == 24);
  const auto values = [&](std::size_t index) {
    std::string text;
    for (const AxisValue& value : study.point(index).values) text += value.plain + ' ';
    return text;
  };
  CHECK(values(0) == "1 0.5 1 ");
  CHECK(values(1) == "1 0.5 2 ");
  CHECK(values(4) == "1 1 1 ");
  CHECK(values(8) == "1.5 0.5 1 ");
  CHECK(values(23) == "2 1 4 ");
  CHECK(seeds(study).size() == 24);
}

TEST_CASE("a point's scene has its values, and its seed", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(grid_study);
  const sweep::Point point = study.point(13);
  const Scene scene = line(study, point);
  CHECK(scene.sensor.depths == std::vector{1.5});
  CHECK(std::get<RigidContact>(scene.contacts.at(0)).half_width == 1.0);
  CHECK(scene.noise->seed == point.seed);
  CHECK(point.seed < std::uint64_t{1} << 53U);
}

TEST_CASE("a seed that is an axis keeps the axis' value", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study =
      folder.study("scene = \"pad.toml\"\n[[axis]]\nkey = \"noise.seed\"\nvalues = [11, 12]\n");
  CHECK(line(study, study.point(1)).noise->seed == 12);
}

TEST_CASE("a point's seed depends on it alone", "[sweep]") {
  const StudyFolder folder;
  const auto before = seeds(folder.study(grid_study));
  const std::set<std::uint64_t> different = [&] {
    std::set<std::uint64_t> all;
    for (const auto& [name, seed] : before) all.insert(seed);
    return all;
  }();
  CHECK(different.size() == before.size());

  SECTION("a value more on an axis changes no other point") {
    const auto after =
        seeds(folder.study(replaced(grid_study, "[1.0, 1.5, 2]", "[0.5, 1, 1.5, 2.0]")));
    REQUIRE(after.size() == 32);
    for (const auto& [name, seed] : before) CHECK(after.at(name) == seed);
  }
  SECTION("so do more repeats") {
    const auto after = seeds(folder.study(replaced(grid_study, "repeats = 4", "repeats = 5")));
    for (const auto& [name, seed] : before) CHECK(after.at(name) == seed);
  }
  SECTION("the order of the axes is nothing to it") {
    const auto after =
        seeds(folder.study("scene = \"pad.toml\"\nseed = 3\nrepeats = 4\n"
                           "[[axis]]\nkey = \"contact.0.half_width\"\nvalues = [0.5, 1.0]\n"
                           "[[axis]]\nkey = \"sensor.depth\"\nvalues = [1.0, 1.5, 2]\n"));
    CHECK(after.at("0.5 2 3 ") == before.at("2 0.5 3 "));
  }
  SECTION("another seed of the study is another seed of all") {
    const auto after = seeds(folder.study(replaced(grid_study, "seed = 3", "seed = 4")));
    for (const auto& [name, seed] : before) CHECK(after.at(name) != seed);
  }
}

TEST_CASE("the hash follows what answers depend on, and nothing else", "[sweep]") {
  const StudyFolder folder;
  const std::string hash = folder.study(grid_study).hash();
  CHECK(folder.study("title = \"x\"\n" + grid_study + "# more\n").hash() == hash);
  CHECK(folder.study(replaced(grid_study, "[0.5, 1.0]", "[0.5, 1.1]")).hash() != hash);
  CHECK(folder.study(replaced(grid_study, "seed = 3", "seed = 4")).hash() != hash);
  folder.write("pad.toml", test::pad + "# another\n");
  CHECK(folder.study(grid_study).hash() != hash);
}

TEST_CASE("the hash follows the files that a scene names, and those of an axis", "[sweep]") {
  const StudyFolder folder;
  const std::string rest =
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n[reconstruct]\nalpha = 1e-3\n";
  const std::string taxels = "name,y,depth\na,-1,1.5\nb,0,1.5\nc,1,1.5\n";
  folder.write("taxels.csv", taxels);
  folder.write("others.csv", taxels);
  folder.write("pad.toml", "[sensor]\ntaxels = \"taxels.csv\"\nreads = [\"stress_x\"]\n" + rest);
  const std::string one =
      "scene = \"pad.toml\"\n[[axis]]\nkey = \"reconstruct.alpha\"\nvalues = [1e-3]\n";
  const std::string two =
      one + "[[axis]]\nkey = \"sensor.taxels\"\nvalues = [\"taxels.csv\", \"others.csv\"]\n";
  const std::string of_one = folder.study(one).hash();
  const std::string of_two = folder.study(two).hash();
  CHECK(folder.study(one).hash() == of_one);
  folder.write("others.csv", taxels + "d,2,1.5\n");
  CHECK(folder.study(one).hash() == of_one);
  CHECK(folder.study(two).hash() != of_two);
  folder.write("taxels.csv", taxels + "d,2,1.5\n");
  CHECK(folder.study(one).hash() != of_one);
}

TEST_CASE("a skin is swept as a line is", "[sweep][skin]") {
  const StudyFolder folder;
  folder.write("skin.toml",
               "[sensor]\nrows = 4\ncolumns = 4\npitch = 2.0\ndepth = 2.0\n"
               "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
               "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
               "[[contact]]\nshape = \"sphere\"\nradius = 2.0\nforce = 1.0\nfriction = 0.3\n"
               "[noise]\nrms = 1e-4\nseed = 7\n");
  const std::string text =
      "scene = \"skin.toml\"\n[[axis]]\nkey = \"contact.0.force\"\nvalues = "
      "[0.5, 1.0, -1.0]\n";
  const sweep::Study study = folder.study(text);
  const sweep::Point point = study.point(1);
  CHECK(std::get<SkinScene>(study.scene(point)).noise->seed == point.seed);
  const auto simulator = lab::make_simulator();
  const std::vector<sweep::Row> rows = sweep::solve(study, 1, *simulator);
  REQUIRE(rows.size() == 1);
  const sweep::Row& row = rows.front();
  CHECK(row.method == "tikhonov");
  CHECK(row.verdict == "ok");
  const lab::Experiment alone = lab::run(std::get<SkinScene>(study.scene(point)));
  const UncertainWrench& wrench = alone.results.front().answer.wrench;
  CHECK(row.force == wrench.normal.value);
  CHECK(std::abs(wrench.normal.value - 1.0) < 2.5 * wrench.normal.deviation);
  CHECK(row.centre_z == wrench.centre_z.value().value);
  CHECK(row.error.value() > 0.0);
  CHECK(row.error.value() < 0.5);
  CHECK(row.error_tangential.value() > 0.0);
  const std::vector<sweep::Row> bad = sweep::solve(study, 2, *simulator);
  REQUIRE(bad.size() == 1);
  CHECK_THAT(bad.front().failure, ContainsSubstring("contact.force"));
  CHECK_THAT(
      refusal(folder, "scene = \"skin.toml\"\n[[axis]]\nkey = \"sensor.colums\"\nvalues = [1]\n"),
      ContainsSubstring("columns"));
}

TEST_CASE("ranges have both ends, and equal steps or equal ratios", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(
      "scene = \"pad.toml\"\n"
      "[[axis]]\nkey = \"sensor.depth\"\nfrom = 0.1\nto = 0.5\ncount = 5\n"
      "[[axis]]\nkey = \"noise.rms\"\nfrom = 1e-4\nto = 1e-1\ncount = 4\nscale = \"log\"\n"
      "[[axis]]\nkey = \"sensor.count\"\nfrom = 5\nto = 9\ncount = 9\nwhole = true\n");
  const auto plain = [&](std::size_t axis) {
    std::vector<std::string> all;
    for (const AxisValue& value : study.axes()[axis].values) all.push_back(value.plain);
    return all;
  };
  CHECK(plain(0) == std::vector<std::string>{"0.1", "0.2", "0.3", "0.4", "0.5"});
  CHECK(plain(1) == std::vector<std::string>{"0.0001", "0.001", "0.01", "0.1"});
  CHECK(plain(2) == std::vector<std::string>{"5", "6", "7", "8", "9"});  // none twice
  CHECK(line(study, study.point(0)).sensor.count == 5);
}

TEST_CASE("draws fill their ranges, and more draws begin with the same", "[sweep]") {
  const StudyFolder folder;
  for (const std::string kind : {"random", "sobol"}) {
    CAPTURE(kind);
    const auto drawn = [&](int count) {
      return folder.study("scene = \"pad.toml\"\n[draw]\nkind = \"" + kind +
                          "\"\ncount = " + std::to_string(count) +
                          "\n[[axis]]\nkey = \"sensor.depth\"\nfrom = 1.0\nto = 2.0\n"
                          "[[axis]]\nkey = \"noise.rms\"\nfrom = 1e-4\nto = 1e-2\nscale = \"log\"\n"
                          "[[axis]]\nkey = \"contact.0.force\"\nvalues = [1, 2]\n");
    };
    const sweep::Study study = drawn(64);
    REQUIRE(study.points() == 128);
    const auto& depths = study.axes()[0].values;
    const auto& noise = study.axes()[1].values;
    double mean = 0.0;
    double mean_log = 0.0;
    for (std::size_t i = 0; i < 64; ++i) {
      CHECK((number(depths[i]) >= 1.0 && number(depths[i]) <= 2.0));
      CHECK((number(noise[i]) >= 1e-4 && number(noise[i]) <= 1e-2));
      mean += number(depths[i]) / 64;
      mean_log += std::log10(number(noise[i])) / 64;
    }
    // Sobol's first 63 points and 0 would be a lattice's; of random ones this is four deviations.
    const double off = kind == "sobol" ? 0.02 : 0.15;
    CHECK_THAT(mean, WithinAbs(1.5, off));
    CHECK_THAT(mean_log, WithinAbs(-3.0, 2.0 * off));
    CHECK(std::equal(depths.begin(), depths.begin() + 32, drawn(32).axes()[0].values.begin()));
    // One after the other: the draws vary faster than the axes of the file.
    CHECK(study.point(1).values[0] == depths[1]);
    CHECK(study.point(64).values[0] == depths[0]);
    CHECK(study.point(64).values[2].plain == "2");
  }
}

TEST_CASE("values of every kind reach the scene", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(
      "scene = \"pad.toml\"\n"
      "[[axis]]\nkey = \"sensor.reads\"\nvalues = [[\"stress_x\"], [\"stress_x\", \"shear_xy\"]]\n"
      "[[axis]]\nkey = \"reconstruct.alpha\"\nvalues = [\"rgcv\", 1e-3]\n"
      "[[axis]]\nkey = \"reconstruct.nonnegative\"\nvalues = [true, false]\n"
      "[[axis]]\nkey = \"quantization.bits\"\nvalues = [8, 12]\n"
      "[[axis]]\nkey = \"quantization.range\"\nvalues = [[-4.0, 4.0]]\n");
  const Scene scene = line(study, study.point(8));
  CHECK(scene.sensor.reads.size() == 2);
  CHECK(scene.reconstruct.alpha_rule == AlphaRule::rgcv);
  CHECK(scene.reconstruct.nonnegative);
  CHECK(scene.quantization.has_value());  // a table that the base scene does not have
  CHECK(study.point(8).values[1].plain == "rgcv");
}

TEST_CASE("an axis has the unit that its scene states, and none where it states none", "[sweep]") {
  const StudyFolder folder;
  const std::string axes =
      "scene = \"pad.toml\"\nrepeats = 2\n"
      "[[axis]]\nkey = \"sensor.depth\"\nvalues = [1, 2]\n"
      "[[axis]]\nkey = \"contact.0.force\"\nfrom = 1\nto = 2\ncount = 2\n"
      "[[axis]]\nkey = \"noise.rms\"\nvalues = [1]\n"
      "[[axis]]\nkey = \"material.youngs_modulus\"\nvalues = [1]\n"
      "[[axis]]\nkey = \"material.poisson_ratio\"\nvalues = [0.3]\n"
      "[[axis]]\nkey = \"reconstruct.alpha\"\nvalues = [\"rgcv\", 1e-3]\n"
      "[[axis]]\nkey = \"low_pass.cutoff\"\nvalues = [10]\n"
      "[[axis]]\nkey = \"sensor.reads\"\nvalues = [[\"stress_x\"]]\n";
  const std::vector<std::string> bare = {"", "", "", "", "", "", "Hz", "", ""};
  CHECK(folder.study(axes).units().axes == bare);
  CHECK(folder.study(axes).units().force.empty());
  folder.write("pad.toml",
               "[units]\nlength = \"mm\"\nstress = \"kPa\"\nmodulus = \"MPa\"\n" + test::pad);
  const std::vector<std::string> stated = {"mm", "N/m", "kPa", "MPa", "", "", "Hz", "", ""};
  CHECK(folder.study(axes).units().axes == stated);
  CHECK(folder.study(axes).units().force == "N/m");
  const std::string varying =
      axes + "[[axis]]\nkey = \"units.length\"\nvalues = [\"mm\", \"cm\"]\n";
  CHECK(folder.study(varying).units().axes == std::vector<std::string>(10));
}

TEST_CASE("what is wrong with a study is told at its place, before anything is computed",
          "[sweep]") {
  const StudyFolder folder;
  const std::string axis = "scene = \"pad.toml\"\n[[axis]]\nkey = ";
  const std::pair<std::string, std::string> wrong[] = {
      {axis + "\"sensor.deth\"\nvalues = [1]\n", "did you mean depth?"},
      {axis + "\"sensr.depth\"\nvalues = [1]\n", "did you mean sensor?"},
      {axis + "\"contact.1.force\"\nvalues = [1]\n", "has 1, counted from 0"},
      {axis + "\"contact.first.force\"\nvalues = [1]\n", "has 1, counted from 0"},
      {axis + "\"sensor.depth.x\"\nvalues = [1]\n", "is not a table"},
      {axis + "\"sensor..depth\"\nvalues = [1]\n", "dotted path"},
      {axis + "\"sensor.depth\"\nvalues = []\n", "at least one value"},
      {"keep = [\"force\", \"traction\"]\n" + axis + "\"sensor.depth\"\nvalues = [1]\n",
       "did you mean \"tractions\"?"},
      {"keep = [\"force\", \"force\"]\n" + axis + "\"sensor.depth\"\nvalues = [1]\n",
       "1:18: error: keep names \"force\" twice"},
      {"keep = []\n" + axis + "\"sensor.depth\"\nvalues = [1]\n", "without keep, rows have alpha"},
      {"keep = \"force\"\n" + axis + "\"sensor.depth\"\nvalues = [1]\n", "must be a list of names"},
      {"keep = [1]\n" + axis + "\"sensor.depth\"\nvalues = [1]\n", "must be the name of a column"},
      {axis + "\"sensor.depth\"\nvalues = [1, 1.0]\n", "twice"},
      {axis + "\"sensor.depth\"\nvalues = [1979-05-27]\n", "must hold numbers"},
      {axis + "\"sensor.depth\"\nvalues = 1\n", "must be a list"},
      {axis + "\"sensor.depth\"\n", "axis.values is missing"},
      {axis + "\"sensor.depth\"\nfrom = 1\nto = 2\ncount = 0\n", "must be from 1"},
      {axis + "\"sensor.depth\"\nfrom = 1\nto = 2\n", "nothing says how many"},
      {axis + "\"sensor.depth\"\nfrom = 1\n", "axis.to is missing"},
      {axis + "\"sensor.depth\"\nfrom = 0\nto = 2\ncount = 3\nscale = \"log\"\n", "must be > 0"},
      {axis + "\"sensor.depth\"\nfrom = -1e308\nto = 1e308\ncount = 3\n", "too far apart"},
      {axis + "\"sensor.depth\"\nvalues = [1]\ncount = 3\n", "has no place without axis.from"},
      {axis + "\"sensor.depth\"\nvalue = [1]\n", "did you mean values?"},
      {axis + "\"sensor.depth\"\nvalues = [1]\n[draw]\nkind = \"sobol\"\ncount = 2\n",
       "nothing to draw"},
      {axis + "\"sensor.depth\"\nvalues = [1]\n[[axis]]\nkey = \"sensor.depth\"\nvalues = [2]\n",
       "names \"sensor.depth\" twice"},
      {"scene = \"none.toml\"\n[[axis]]\nkey = \"sensor.depth\"\nvalues = [1]\n", "no such file"},
      {"scene = \"../pad.toml\"\n[[axis]]\nkey = \"sensor.depth\"\nvalues = [1]\n",
       "allow_outside"},
      {"scene = \"study.toml\"\n[[axis]]\nkey = \"sensor.depth\"\nvalues = [1]\n", "unknown key"},
      {"scene = \"pad.toml\"\n", "[axis] is missing"},
      {"[[axis]]\nkey = \"sensor.depth\"\nvalues = [1]\n", "[scene] is missing"},
      {"", "empty"},
  };
  for (const auto& [text, message] : wrong) {
    CAPTURE(text);
    CHECK_THAT(refusal(folder, text), ContainsSubstring(message));
  }
  const std::string misspelt = refusal(folder, axis + "\"sensor.deth\"\nvalues = [1]\n");
  CHECK_THAT(misspelt, ContainsSubstring("study.toml:3:7: error: axis.key"));
}

TEST_CASE("a million million points are refused, and counted", "[sweep]") {
  const StudyFolder folder;
  std::string text = "scene = \"pad.toml\"\n";
  for (const char* key : {"sensor.depth", "sensor.pitch"})
    text += std::string("[[axis]]\nkey = \"") + key + "\"\nfrom = 1\nto = 2\ncount = 1000000\n";
  CHECK_THAT(refusal(folder, text), ContainsSubstring("makes 1e+12 points, more than 1000000"));
}

TEST_CASE("a base scene that fails for some values fails for those alone", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(
      "scene = \"pad.toml\"\n[[axis]]\nkey = \"sensor.depth\"\nvalues = [-1.0, 1.5]\n");
  CHECK_THROWS_WITH(line(study, study.point(0)), ContainsSubstring("sensor.depth must be > 0"));
  CHECK(line(study, study.point(1)).sensor.depths.front() == 1.5);
}

TEST_CASE("a row's failure is the same every time, and has its units", "[sweep]") {
  const StudyFolder folder;
  folder.write("pad.toml", replaced(test::pad, "[\"tikhonov\", \"dft\"]", "[\"network\"]"));
  const sweep::Study study = folder.study(grid_study);
  const auto failure = [&](const std::string& where) {
    Failing simulator(where);
    const std::vector<sweep::Row> rows = sweep::solve(study, 0, simulator);
    REQUIRE(rows.size() == 1);
    return rows.front().failure;
  };
  const std::string one = failure("/tmp/tactile-net-run-a1b2c3");
  CHECK(one == failure("/scratch/job.7/tactile-net-run-d4e5f6"));
  CHECK_THAT(one, ContainsSubstring("3 N/mm and 1/s"));
}
