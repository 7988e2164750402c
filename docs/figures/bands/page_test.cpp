#include <chrono>
#include <filesystem>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

TEST_CASE("the page of bands is the same however many threads write it", "[cli]") {
  const Folder folder;
  const auto written = [&](const char* threads, const char* seed) {
    const ProcessResult result =
        run_process({SBC, folder / "page.md", "--draws", "20", "--contacts", "2", "--seed", seed,
                     "--threads", threads},
                    {.time_limit = std::chrono::minutes(2)});
    REQUIRE(result.end == ProcessResult::End::exited);
    REQUIRE(result.code == 0);
    return read_text(folder / "page.md") + read_text(folder / "page/ranks.svg");
  };
  const std::string page = written("1", "1");
  CHECK_THAT(page, ContainsSubstring("--seed 1 --draws 20 --contacts 2`") &&
                       ContainsSubstring("SHA-256") && ContainsSubstring("<svg"));
  CHECK(page.find("nan") == std::string::npos);
  CHECK(page == written("2", "1"));
  CHECK(page != written("2", "2"));
}

TEST_CASE("the page of bands is not written by an option that is not there", "[cli]") {
  const Folder folder;
  const std::string page = folder / "page.md";
  CHECK(run_process({SBC}, {}).code == 2);
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--draw", "3"},
                                                  {"--draws"},
                                                  {"--draws", "0"},
                                                  {"--draws", "3x"}}) {
    std::vector<std::string> command{SBC, page};
    command.insert(command.end(), options.begin(), options.end());
    const ProcessResult result = run_process(command, {});
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring("usage: tactile-net-sbc"));
  }
  CHECK_FALSE(std::filesystem::exists(page));
}
