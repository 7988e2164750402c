#include "tactile_net/numeric/text.hpp"

#include "tests/catch.hpp"

namespace tactile_net {

TEST_CASE("a word is quoted only where a shell would read it otherwise", "[text]") {
  for (const char* plain : {"pad.toml", "--readings", "a/b_c-1.csv", "t=1,4-44", "50%"})
    CHECK(shell_word(plain) == plain);
  CHECK(shell_word("") == "''");
  CHECK(shell_word("my pad.toml") == "'my pad.toml'");
  CHECK(shell_word("$(id).csv") == "'$(id).csv'");
  CHECK(shell_word("Anna's.csv") == "'Anna'\\''s.csv'");
}

TEST_CASE("joined parts are split into the same parts, empty ones too", "[text]") {
  for (const std::vector<std::string>& parts :
       {std::vector<std::string>{"", "a"}, {"", "", ""}, {"a", "", "b"}, {"a"}, {""}}) {
    const std::string text = join(parts, ",");
    std::vector<std::string> again;
    for (const std::string_view part : split(text, ',')) again.emplace_back(part);
    CHECK(again == parts);
  }
}

}  // namespace tactile_net
