// Skins on the command line: run, simulate, solve; and who does not know them says so.
#include <nlohmann/json.hpp>
#include <string>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
using Json = nlohmann::json;

namespace {

const std::string skin =
    "title = \"A skin\"\n[units]\nlength = \"mm\"\nmodulus = \"MPa\"\nstress = \"kPa\"\n"
    "[sensor]\nrows = 5\ncolumns = 4\npitch = 1.0\ndepth = 1.0\n"
    "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"sphere\"\nradius = 1.5\nforce = 0.2\nfriction = 0.4\n"
    "[noise]\nrms = 0.02\n[reconstruct]\nalpha = 1e-4\n";

/// A .npy of doubles in C order.
std::string npy(const std::string& shape, const std::vector<double>& values) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }";
  header.resize(117, ' ');
  header += '\n';
  std::string text = "\x93NUMPY";
  text += '\x01';
  text += '\0';
  text += static_cast<char>(header.size());
  text += '\0';
  text += header;
  text.append(reinterpret_cast<const char*>(values.data()), 8 * values.size());
  return text;
}

std::vector<double> numbers(const std::string& row) {
  std::vector<double> all;
  for (std::size_t at = 0; at < row.size();) {
    all.push_back(std::stod(row.substr(at)));
    const std::size_t comma = row.find(',', at);
    if (comma == row.npos) break;
    at = comma + 1;
  }
  return all;
}

}  // namespace

TEST_CASE("run of a skin says force, drag and place, and draws maps", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin);
  const ProcessResult result = tool({"run", path, "--out", folder / "out"});
  CAPTURE(result.errors, result.output);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("force into the skin"));
  CHECK_THAT(result.output, ContainsSubstring("5 x 4 taxels"));
  const std::string html = read_text(folder / "out/report.html");
  for (const char* part : {"What presses", "What was found", "class=\"arrow\"", "data:image/png",
                           "prefers-color-scheme", "readings.csv", "tractions.csv"})
    CHECK_THAT(html, ContainsSubstring(part));
  const Json json = Json::parse(read_text(folder / "out/result.json"));
  CHECK(json["kind"] == "skin_run");
  const std::size_t cells = json["grid"]["y"].size() * json["grid"]["z"].size();
  CHECK(json["answer"]["tractions"]["tangential_z"].size() == cells);
  CHECK_THAT(json["answer"]["resultant"]["normal"]["value"].get<double>(), WithinAbs(0.2, 0.02));
  CHECK_THAT(read_text(folder / "out/tractions.csv"),
             ContainsSubstring("y,z,normal,tangential_y,tangential_z,normal_deviation"));
}

TEST_CASE("what simulate records of a skin, solve finds as run does", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin);
  REQUIRE(
      tool({"simulate", path, "-q", "-o", folder / "g.csv", "--truth", folder / "f.csv"}).code ==
      0);
  const std::string csv = read_text(folder / "g.csv");
  CHECK(csv.starts_with("stress_x_0_0,stress_x_0_1"));
  CHECK(read_text(folder / "f.csv").starts_with("normal_0_0,normal_0_1"));
  const ProcessResult solved =
      tool({"solve", path, "--readings", folder / "g.csv", "-q", "-o", folder / "t.csv",
            "--uncertainty", folder / "u.csv", "--out", folder / "page", "--json", folder / "s"});
  CAPTURE(solved.errors);
  REQUIRE(solved.code == 0);
  const Json run = Json::parse(tool({"run", path, "--json", "-"}).output);
  const Json json = Json::parse(read_text(folder / "s"));
  CHECK(json["kind"] == "skin_solve");
  const double force = run["answer"]["resultant"]["normal"]["value"];
  CHECK_THAT(json["frames"][0]["resultant"]["normal"]["value"].get<double>(),
             WithinRel(force, 1e-9));
  CHECK(read_text(folder / "u.csv").starts_with("normal,normal_deviation"));
  CHECK_THAT(read_text(folder / "page/report.html"), ContainsSubstring("hardest press"));

  SECTION("and of an array (frames, rows, columns, channels)") {
    const std::vector<double> channels_first = numbers(csv.substr(csv.find('\n') + 1));
    REQUIRE(channels_first.size() == 60);
    std::vector<double> channels_last;
    for (std::size_t taxel = 0; taxel < 20; ++taxel)
      for (std::size_t c = 0; c < 3; ++c) channels_last.push_back(channels_first[20 * c + taxel]);
    folder.write("g.npy", npy("(1, 5, 4, 3)", channels_last));
    const ProcessResult same = tool({"solve", path, "--readings", folder / "g.npy", "-q", "-o",
                                     folder / "n.csv", "--json", folder / "n"});
    CAPTURE(same.errors);
    REQUIRE(same.code == 0);
    CHECK(Json::parse(read_text(folder / "n"))["frames"][0]["resultant"] ==
          json["frames"][0]["resultant"]);
  }
  SECTION("but not where rows and columns are exchanged: both shapes are named") {
    folder.write("g.npy", npy("(1, 4, 5, 3)", std::vector<double>(60)));
    const ProcessResult bad = tool({"solve", path, "--readings", folder / "g.npy", "-q"});
    CHECK(bad.code != 0);
    CHECK_THAT(bad.errors, ContainsSubstring("(1, 4, 5, 3)") &&
                               ContainsSubstring("(frames, 5, 4, 3)") &&
                               ContainsSubstring("swapaxes"));
  }
}

TEST_CASE("readings whose names are no taxels are refused", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin);
  folder.write("g.csv", "stress_x_9_9\n1.0\n");
  const ProcessResult bad = tool({"solve", path, "--readings", folder / "g.csv", "-q"});
  CHECK(bad.code != 0);
  CHECK_THAT(bad.errors, ContainsSubstring("g.csv"));
}

TEST_CASE("a command that does not know skins yet says so", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin);
  for (const char* command : {"certify", "relax", "gen", "plan"}) {
    CAPTURE(command);
    const ProcessResult refused = tool({command, path});
    CHECK(refused.code != 0);
    CHECK_THAT(refused.errors, ContainsSubstring("[sensor] is of a skin"));
    CHECK_THAT(refused.errors, ContainsSubstring("run, simulate, solve and identify know skins"));
  }
  CHECK_THAT(tool({"run", path, "--explain"}).errors, ContainsSubstring("--explain"));
  CHECK_THAT(tool({"solve", path, "--method", "dft", "--readings", "x.csv"}).errors,
             ContainsSubstring("--method"));
}
