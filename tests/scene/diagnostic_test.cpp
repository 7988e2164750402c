#include "tactile_net/scene/diagnostic.hpp"

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("a diagnostic shows place, line, caret and hint", "[diagnostic]") {
  CHECK(text({.file = "s.toml",
              .line = 3,
              .column = 9,
              .message = "sensor.depth must be > 0 (got -1)",
              .hint = "give a depth",
              .source = "depth = -1"}) ==
        "s.toml:3:9: error: sensor.depth must be > 0 (got -1)\n"
        "  depth = -1\n"
        "          ^\n"
        "  hint: give a depth\n");
}

TEST_CASE("a tab in the line does not misplace the caret", "[diagnostic]") {
  CHECK_THAT(text({.file = "s", .line = 1, .column = 3, .message = "m", .source = "\tab"}),
             ContainsSubstring("  \tab\n  \t ^\n"));
}

TEST_CASE("a diagnostic of a whole file has no place", "[diagnostic]") {
  CHECK(text({.file = "s.toml", .message = "the scene is empty"}) ==
        "s.toml: error: the scene is empty\n");
}

TEST_CASE("an input error is all its diagnostics", "[diagnostic]") {
  const InputError error({{.file = "a", .message = "x"}, {.file = "b", .message = "y"}});
  CHECK(std::string(error.what()) == "a: error: x\nb: error: y\n");
  CHECK(error.diagnostics().size() == 2);
}
