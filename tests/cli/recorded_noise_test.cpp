// A coarse array whose scene does not state the noise: the recording shows it.
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
