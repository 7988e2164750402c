// Frames that cannot be true, through the command.
#include <filesystem>
#include <functional>
#include <sstream>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

const std::string finger_scene = scene("coarse/finger.toml");

/// The frame of the finger's scene, changed.
std::string changed_frames(const std::function<double(double, std::size_t)>& change) {
  const ProcessResult simulated = run_tool({"simulate", finger_scene, "-o", "-"});
  REQUIRE(simulated.code == 0);
  std::istringstream lines(simulated.output);
  std::string header;
  std::getline(lines, header);
  std::string text = header + '\n';
  std::string field;
  for (std::size_t i = 0; std::getline(lines, field, ','); ++i)
    text += (i > 0 ? "," : "") + std::to_string(change(std::stod(field), i));
  return text + '\n';
}

/// The third column from the end of the only row.
std::string third_last_field(const ProcessResult& result) {
  std::string row = result.output.substr(result.output.find('\n') + 1);
  for (int k = 0; k < 2; ++k) row.resize(row.rfind(','));
  return row.substr(row.rfind(',') + 1);
}

/// Its output is the file of bands.
ProcessResult solve(const std::string& readings) {
  const Folder folder;
  ProcessResult result = run_tool({"solve", finger_scene, "--readings", "-", "-o", folder / "t.csv",
                                   "--uncertainty", folder / "u.csv"},
                                  readings);
  result.output = read_text(folder / "u.csv");
  return result;
}

}  // namespace

TEST_CASE("solve says of every frame whether its readings can be true", "[cli]") {
  const ProcessResult honest = solve(changed_frames([](double g, std::size_t) { return g; }));
  CHECK(honest.code == 0);
  CHECK_THAT(honest.output, ContainsSubstring(",data,alpha,verdict\n"));
  CHECK(third_last_field(honest) == "0");
  CHECK_THAT(honest.errors, !ContainsSubstring("doubted"));

  const ProcessResult unit = solve(changed_frames([](double g, std::size_t) { return 1e9 * g; }));
  CHECK(unit.code == 0);
  CHECK(third_last_field(unit) == "1");
  CHECK_THAT(unit.errors, ContainsSubstring("1 of 1 frame has readings to be doubted"));

  CHECK(third_last_field(solve(changed_frames([](double g, std::size_t) { return -g; }))) == "2");
  CHECK(third_last_field(solve(changed_frames([](double g, std::size_t) { return g - 3.0; }))) ==
        "4");
}

TEST_CASE("JSON and the page of a recording say which frames' readings are doubted", "[cli]") {
  const Folder folder;
  const ProcessResult result =
      run_tool({"solve", finger_scene, "--readings", "-", "--out", folder / "out", "--json", "-"},
               changed_frames([](double g, std::size_t) { return -g; }));
  REQUIRE(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("\"noise_known\": true"));
  CHECK_THAT(result.output, ContainsSubstring("\"pulls\""));
  const std::string page = read_text(folder / "out/report.html");
  CHECK_THAT(page, ContainsSubstring("cannot be those of a contact"));
  CHECK_THAT(read_text(folder / "out/shown.csv"), ContainsSubstring(",pulls\n"));
}
