#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

TEST_CASE("the thesis' page is written with its pictures and its numbers", "[cli]") {
  const Folder folder;
  const ProcessResult result = run_process({THESIS, folder.path().string()}, {});
  REQUIRE(result.code == 0);
  const std::string page = read_text(folder / "thesis.md");
  CHECK_THAT(page, ContainsSubstring("| stress_x | 3.03e-07 | 3.03e-07 |") &&
                       ContainsSubstring("| strain_x | 4.04e-05 | 4.04e-05 |"));
  // Every picture the page names is there.
  std::size_t pictures = 0;
  for (std::size_t at = page.find("](thesis/"); at != std::string::npos;
       at = page.find("](thesis/", at + 1)) {
    const std::size_t begin = at + 2;
    const std::string name = page.substr(begin, page.find(')', begin) - begin);
    CAPTURE(name);
    CHECK_THAT(read_text(folder / name), StartsWith("<svg"));
    ++pictures;
  }
  CHECK(pictures >= 13);
  CHECK(page.find('{') == std::string::npos);
  CHECK(run_process({THESIS}, {}).code == 2);
}
