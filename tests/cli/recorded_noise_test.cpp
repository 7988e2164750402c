// What a scene does not state and its recording shows: the noise of a coarse array, broken taxels.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "tests/catch.hpp"
#include "tests/cli/csv.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

/// Nine taxels, two depths apart; nothing for a second, then a press of 50 N/m for 1.5 s.
const std::string pressed_finger =
    "[units]\nlength = \"mm\"\nmodulus = \"kPa\"\nstress = \"kPa\"\nforce = \"N/m\"\n"
    "[sensor]\ncount = 9\npitch = 3.0\ndepth = 1.5\nreads = [\"stress_x\"]\n"
    "[material]\nyoungs_modulus = 200\npoisson_ratio = 0.45\n[time]\nrate = 100\nframes = 250\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.5\ncenter = 0.6\ntrajectory = [{ t = 0.0, "
    "force = 0.0 }, { t = 1.0, force = 0.0 }, { t = 1.2, force = 50.0 }, { t = 3.0, force = 50.0 "
    "}]\n";

const std::string comes_and_stays =
    "trajectory = [{ t = 0.0, force = 1e-6 }, { t = 0.3, force = 1e-6 }, { t = 0.32, force = 20.0 "
    "}, "
    "{ t = 0.5, force = 20.0 }]\n";
const std::string rest_of_pad =
    "depth = 1.5\nreads = [\"stress_x\"]\n[material]\nyoungs_modulus = 200.0\n"
    "poisson_ratio = 0.45\n[noise]\nrms = 0.02\n[time]\nrate = 100.0\nframes = 40\n"
    "[reconstruct]\ntangential = false\nnonnegative = true\n";

struct SolvedRow {
  double force = 0.0;
  double deviation = 0.0;
  std::string verdict;
};
SolvedRow last_row(const std::string& csv) {
  std::vector<std::string> fields = fields_of(csv.substr(csv.rfind('\n', csv.size() - 2) + 1));
  std::string& verdict = fields.back();
  verdict.erase(verdict.find_last_not_of("\r\n") + 1);
  return {std::stod(fields.at(1)), std::stod(fields.at(2)), verdict};
}

}  // namespace

TEST_CASE("the noise that a scene does not state is that of still frames", "[cli][noise]") {
  const Folder folder;
  std::ofstream(folder / "stated.toml") << pressed_finger << "[noise]\nrms = 0.1\n";
  std::ofstream(folder / "silent.toml") << pressed_finger;
  REQUIRE(run_tool({"simulate", folder / "stated.toml", "-o", folder / "r.csv"}).code == 0);
  const auto solve = [&](const std::string& scene, const std::string& readings) {
    return run_tool({"solve", folder / scene, "--readings", readings, "-o", folder / "f.csv",
                     "--uncertainty", folder / "u.csv"});
  };
  REQUIRE(solve("stated.toml", folder / "r.csv").code == 0);
  const SolvedRow stated = last_row(read_text(folder / "u.csv"));
  const ProcessResult taken = solve("silent.toml", folder / "r.csv");
  REQUIRE(taken.code == 0);
  CHECK_THAT(taken.errors, ContainsSubstring("the scene states no noise: ") &&
                               ContainsSubstring("under [noise], rms = 0.1"));
  const SolvedRow found = last_row(read_text(folder / "u.csv"));
  CHECK(found.verdict == "ok");
  CHECK_THAT(found.force, WithinRel(stated.force, 0.01));
  CHECK_THAT(found.deviation, WithinRel(stated.deviation, 0.15));
  CHECK(std::abs(found.force - 50.0) <= 2.0 * found.deviation);

  // Where something moves all the time nothing shows it.
  const std::string text = read_text(folder / "r.csv");
  std::ofstream(folder / "short.csv") << text.substr(0, text.find("\n0.03,") + 1);
  const ProcessResult not_taken = solve("silent.toml", folder / "short.csv");
  REQUIRE(not_taken.code == 0);
  CHECK_THAT(not_taken.errors, ContainsSubstring("short.csv: note: the scene states no noise"));
  CHECK(last_row(read_text(folder / "u.csv")).verdict == "noise_needed");

  // Nor where the readings come once: the same is said, and the answers are the same.
  const std::string in_file = read_text(folder / "f.csv");
  const ProcessResult piped =
      run_tool({"solve", folder / "silent.toml", "--readings", "-", "-o", folder / "p.csv"},
               read_text(folder / "short.csv"));
  REQUIRE(piped.code == 0);
  CHECK_THAT(piped.errors, ContainsSubstring("note: the scene states no noise"));
  CHECK(read_text(folder / "p.csv") == in_file);

  // What is wrong with the recording is said once, by who solves it.
  std::ofstream(folder / "bad.csv") << text << "3.0,1,2,x,4,5,6,7,8,9\n";
  const ProcessResult bad = solve("silent.toml", folder / "bad.csv");
  CHECK(bad.code == 2);
  CHECK_THAT(bad.errors, ContainsSubstring("bad.csv:") && ContainsSubstring("frames before it"));
}

TEST_CASE("taxels that a recording shows to be dead are left out as if the scene called them so",
          "[cli][dead]") {
  struct PadWithDead {
    std::string scene, dead, advice;
  };
  const PadWithDead of_line{
      "[sensor]\ncount = 21\npitch = 0.5\n" + rest_of_pad +
          "[[contact]]\nshape = \"cylinder\"\nhalf_width = 0.5\ncenter = 0.1\n" + comes_and_stays,
      "[dead_taxels]\nindices = [8, 9, 10, 11]\n", "indices = [8, 9, 10, 11]"};
  const PadWithDead of_skin{
      "[sensor]\nrows = 5\ncolumns = 5\npitch = 1.5\n" + rest_of_pad +
          "[[contact]]\nshape = \"sphere\"\nradius = 1.0\nplace = [0.3, 0.2]\n" + comes_and_stays,
      "[dead_taxels]\nindices = [12, 13]\n", "indices = [\"2_2\", \"2_3\"]"};
  for (const PadWithDead& pad : {of_line, of_skin}) {
    const Folder folder;
    std::ofstream(folder / "stated.toml") << pad.scene << pad.dead;
    std::ofstream(folder / "silent.toml") << pad.scene;
    REQUIRE(run_tool({"simulate", folder / "stated.toml", "-o", folder / "r.csv"}).code == 0);
    const auto solve = [&](const std::string& scene) {
      return run_tool({"solve", folder / scene, "--readings", folder / "r.csv", "-o",
                       folder / "f.csv", "--uncertainty", folder / "u.csv"});
    };
    const ProcessResult told = solve("stated.toml");
    REQUIRE(told.code == 0);
    CHECK_THAT(told.errors, !ContainsSubstring("left out"));
    const SolvedRow stated = last_row(read_text(folder / "u.csv"));
    const ProcessResult seen = solve("silent.toml");
    REQUIRE(seen.code == 0);
    CHECK_THAT(seen.errors,
               ContainsSubstring("left out of all frames") && ContainsSubstring(pad.advice));
    const SolvedRow found = last_row(read_text(folder / "u.csv"));
    CHECK(found.verdict == stated.verdict);
    CHECK_THAT(found.force, WithinRel(stated.force, 1e-6));
    CHECK_THAT(found.deviation, WithinRel(stated.deviation, 1e-6));
  }
}
