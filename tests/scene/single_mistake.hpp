/// @file
/// One change to a good scene, and exactly one message, at its place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/scene/diagnostic.hpp"
#include "tests/catch.hpp"

namespace tactile_net::test {

/// `place` is "line:column"; "0:0" is the file as a whole.
struct Mistake {
  std::string_view from;
  std::string_view to;
  std::string_view place;
  std::string_view message;
  std::string_view hint = "";
};

/// @param problems_of  the diagnostics of a text
void check_each(std::string_view good, const auto& problems_of,
                const std::vector<Mistake>& mistakes) {
  for (const auto& [from, to, place, message, hint] : mistakes) {
    std::string toml{good};
    const std::size_t at = toml.find(from);
    CAPTURE(from, to);
    REQUIRE(at != std::string::npos);
    toml.replace(at, from.size(), to);

    const std::vector<Diagnostic> problems = problems_of(toml);
    CAPTURE(InputError{problems}.what());
    REQUIRE(problems.size() == 1);
    const Diagnostic& problem = problems.front();
    CHECK(std::to_string(problem.line) + ':' + std::to_string(problem.column) == place);
    CHECK_THAT(problem.message, ContainsSubstring(std::string{message}));
    CHECK_THAT(problem.hint, ContainsSubstring(std::string{hint}));
  }
}

}  // namespace tactile_net::test
