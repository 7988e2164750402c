#include <cmath>
#include <sstream>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

std::vector<std::vector<double>> rows(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  std::vector<std::vector<double>> all;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    all.emplace_back();
    for (std::string field; std::getline(fields, field, ',');)
      all.back().push_back(std::stod(field));
  }
  return all;
}

const std::string header = "t,stress_x_0,stress_x_1,stress_x_2\n";

}  // namespace

TEST_CASE("recorded presses of a pad give its force and its centre", "[cli]") {
  // Finite-element readings, not made by our formulas; frames 0 to 2 are without friction.
  const ProcessResult result = tool(
      {"solve", scene("recorded/thick-pad.toml"), "--readings", scene("recorded/thick-pad.csv")});
  REQUIRE(result.code == 0);
  CHECK_THAT(result.errors, ContainsSubstring("183 columns are not read"));
  const auto found = rows(result.output);
  const auto truth = rows(read_text(scene("recorded/thick-pad.truth.csv")));
  REQUIRE(found.size() == 5);
  for (std::size_t frame = 0; frame < 3; ++frame) {
    CAPTURE(frame);
    double force = 0.0;
    double moment = 0.0;
    for (std::size_t j = 0; j < 61; ++j) {
      const double y = (static_cast<double>(j) - 30.0) * 0.4e-3;
      force += 0.4e-3 * found[frame][j + 1];
      moment += 0.4e-3 * y * found[frame][j + 1];
    }
    CHECK(found[frame][0] == truth[frame][0]);
    CHECK_THAT(force, WithinRel(truth[frame][1], 0.03));
    if (frame > 0) CHECK_THAT(moment / force, WithinAbs(truth[frame][3], 0.2e-3));
  }
}

TEST_CASE("frames stream from standard input, columns in any order", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const std::string a = tool({"solve", path, "--readings", "-"}, header + "0.5,1,2,3\n").output;
  const std::string b = tool({"solve", path, "--readings", "-"},
                             "extra,\"stress_x_2\", stress_x_0,stress_x_1\r\n9,3,1,2\r\n")
                            .output;
  CHECK_THAT(a, StartsWith("t,normal_0,normal_1,normal_2\n0.5,"));
  CHECK(a.substr(a.find("\n0.5,") + 5) == b.substr(b.find('\n') + 1));
}

TEST_CASE("closed_form and dft solve frames too", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  for (const char* method : {"closed_form", "dft"}) {
    const ProcessResult result =
        tool({"solve", path, "--readings", "-", "--method", method}, header + "0,1,2,1\n");
    CHECK(result.code == 0);
    CHECK(rows(result.output).size() == 1);
  }
}

TEST_CASE("a malformed row stops at its place with everything before it written", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const auto [row, place, message] = GENERATE(table<std::string, std::string, std::string>({
      {"1,2,abc,4", ":3:5: error: ", "'abc' is not a number (column stress_x_1)"},
      {"1,2,nan,4", ":3:5: error: ", "'nan' is not finite"},
      {"1,2,,4", ":3:5: error: ", "a number is missing"},
      {"1,2,1e999,4", ":3:5: error: ", "beyond the range"},
      {"1,2,3", ":3:", "3 columns, the header 4"},
      {"1,2,3,4,5", ":3:9: error: ", "more than the header's 4 columns"},
      {"1,2,0x10,4", ":3:5: error: ", "'0x10' is not a number"},
  }));
  CAPTURE(row);
  const std::string csv = folder.write("r.csv", header + "0,1,2,3\n" + row + "\n2,1,2,3\n");
  const ProcessResult result = tool({"solve", path, "--readings", csv, "-o", folder / "f.csv"});
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, StartsWith(csv + place) && ContainsSubstring(message));
  CHECK(rows(read_text(folder / "f.csv")).size() == 1);
}

TEST_CASE("a header that does not fit the scene names the first missing column", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const auto errors = [&](const std::string& csv) {
    const ProcessResult result = tool({"solve", path, "--readings", "-"}, csv);
    CHECK(result.code == 2);
    CHECK(result.output.empty());
    return result.errors;
  };
  CHECK_THAT(errors("t,stress_x_0\n"),
             ContainsSubstring("column 'stress_x_1' is missing and 1 more"));
  CHECK_THAT(errors("stress_x_0,stress_x_0\n"), ContainsSubstring("stands twice"));
  CHECK_THAT(errors(""), ContainsSubstring("no header"));
  CHECK_THAT(errors(std::string(2'000'000, 'x')), ContainsSubstring("longer than"));
}

TEST_CASE("a dead taxel's column may hold anything", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene + "[dead_taxels]\nindices = [1]\n");
  const ProcessResult result = tool({"solve", path, "--readings", "-"}, header + "0,1,broken,3\n");
  CHECK(result.code == 0);
  CHECK(rows(result.output).size() == 1);
}
