// One scene of the folder scenes/ from start to end; CTest names each (CMakeLists.txt).
#include <cstdlib>

#include "tests/catch.hpp"
#include "tests/cli/json_number.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

TEST_CASE("a shipped scene runs, agrees with its circuit and writes a report",
          "[.][shipped-scene]") {
  const char* path = std::getenv("TACTILE_NET_SCENE");
  REQUIRE(path != nullptr);
  CAPTURE(path);
  const Folder folder;
  const ProcessResult result = run_tool({"run", path, "--out", folder / "out"});
  CHECK(result.errors.empty());
  REQUIRE(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("verdict"));
  const std::string html = read_text(folder / "out/report.html");
  CHECK_THAT(html, ContainsSubstring("<svg"));
  CHECK_THAT(html, ContainsSubstring("</html>"));
  CHECK(html.find("src=\"http") == std::string::npos);  // one file, no network
  const std::string json = read_text(folder / "out/result.json");
  if (json.find("\"network\": {") != std::string::npos) {
    // What op-amps and devices add, `run` has judged.
    if (json.find("\"difference_predicted\": null") != std::string::npos &&
        json_number(json, "difference_of_devices") == 0.0)
      CHECK(json_number(json, "difference_to_direct") <= 1e-9);
    CHECK(std::filesystem::exists(folder / "out/network.cir"));
  }
}
