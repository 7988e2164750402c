#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

TEST_CASE("identify explains why two strains on 81 taxels are singular", "[cli]") {
  const ProcessResult result = tool({"identify", scene("two-strains.toml")});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("invisible: tangential traction") &&
                                ContainsSubstring("antisymmetric block of odd order") &&
                                ContainsSubstring("shear_xy's kernel is even"));
}

namespace {

std::string small(const std::string& reads) {
  return "[sensor]\ncount = 15\npitch = 1.0\ndepth = 1.0\nreads = [" + reads +
         "]\n[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n";
}

}  // namespace

TEST_CASE("identify finds nothing hidden from stress and shear", "[cli]") {
  const Folder folder;
  const ProcessResult result =
      tool({"identify", folder.write("s.toml", small("\"stress_x\", \"shear_xy\""))});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("Every traction can be told"));
}

TEST_CASE("identify writes a report and JSON", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small("\"strain_x\", \"strain_y\""));
  const ProcessResult result =
      tool({"identify", path, "--out", folder / "out", "--json", "-", "--traction", "0.5"});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("\"null_modes\"") &&
                                ContainsSubstring("\"traction\": 0.5") &&
                                ContainsSubstring("\"alternatives\""));
  CHECK_THAT(read_text(folder / "out/report.html"), ContainsSubstring("<svg"));
  CHECK(read_text(folder / "out/result.json") == result.output);
}

TEST_CASE("identify refuses what is no amplitude", "[cli]") {
  const ProcessResult result = tool({"identify", scene("two-strains.toml"), "--traction", "-1"});
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, ContainsSubstring("--traction"));
}
