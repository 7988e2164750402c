#include "tactile_net/scene/diagnostic.hpp"

#include <string>

#include "tests/catch.hpp"

using tactile_net::Diagnostic;
using tactile_net::text;

namespace {

Diagnostic at(std::size_t column, std::string source) {
  return {"scene.toml", 12, column, "wrong", "", std::move(source)};
}

/// The second and the third line of a diagnostic's text.
std::string shown(const Diagnostic& diagnostic) {
  const std::string all = text(diagnostic);
  return all.substr(all.find('\n') + 1);
}

}  // namespace

TEST_CASE("a diagnostic is a place, a message, the line with a caret and a hint", "[diagnostic]") {
  Diagnostic diagnostic = at(9, "depth = -1.5");
  diagnostic.message = "sensor.depth must be > 0 (got -1.5)";
  diagnostic.hint = "it counts downwards";
  CHECK(text(diagnostic) ==
        "scene.toml:12:9: error: sensor.depth must be > 0 (got -1.5)\n"
        "depth = -1.5\n"
        "        ^\n"
        "hint: it counts downwards\n");
}

TEST_CASE("what is not known is left out", "[diagnostic]") {
  CHECK(text({"scene.toml", 0, 0, "no such file", "", ""}) == "scene.toml: error: no such file\n");
  CHECK(text({"a.csv", 3, 0, "too short", "", "1,2"}) == "a.csv:3: error: too short\n1,2\n");
}

TEST_CASE("the caret stands below its character", "[diagnostic]") {
  CHECK(shown(at(4, "\ta\tb")) == "\ta\tb\n\t \t^\n");                             // tabs are kept
  CHECK(shown(at(3, "\xC3\xA9\xE2\x82\xAC=")) == "\xC3\xA9\xE2\x82\xAC=\n  ^\n");  // e acute, euro
  CHECK(shown(at(4, "abc")) == "abc\n   ^\n");        // at the line's end
  CHECK(shown(at(99, "abc")) == "abc\n   ^\n");       // and never far beyond
  CHECK(shown(at(2, "\xFF!")) == "\\xff!\n    ^\n");  // not UTF-8
}

TEST_CASE("a long line is cut around the caret", "[diagnostic]") {
  const std::size_t column = GENERATE(1U, 2U, 44U, 45U, 46U, 500U, 955U, 960U, 999U, 1000U);
  CAPTURE(column);
  std::string line(1000, '.');
  line[column - 1] = 'X';
  const std::string both = shown(at(column, line));
  const std::string first = both.substr(0, both.find('\n'));
  const std::string second = both.substr(both.find('\n') + 1);
  CHECK(first.size() <= 120);
  CHECK(first.find('X') == second.find('^'));
}

TEST_CASE("a part of a line knows where it begins", "[diagnostic]") {
  Diagnostic part = at(103, "abc");
  part.source_column = 101;
  CHECK(shown(part) == "abc\n  ^\n");
}

TEST_CASE("control characters do not reach the terminal", "[diagnostic]") {
  Diagnostic diagnostic = at(1, "\x1b[31m\x7f\xC2\x9B");
  diagnostic.message = "unknown key \"\x1b[2J\"";
  CHECK(text(diagnostic) ==
        "scene.toml:12:1: error: unknown key \"\\x1b[2J\"\n\\x1b[31m\\x7f\\x9b\n^\n");
}

TEST_CASE("an error's text is that of all its diagnostics", "[diagnostic]") {
  const Diagnostic one = at(1, "a");
  const Diagnostic two = at(2, "ab");
  CHECK(tactile_net::InputError{{one, two}}.what() == text(one) + text(two));
}
