#include "tactile_net/scene/option_words.hpp"

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("a front end spells the options that messages advise, and nobody else does",
          "[scene][options]") {
  CHECK(option(Option::columns, "2-42") == "columns = 2-42");
  CHECK(option(Option::force) == "force");
  spell_options([](Option one, std::string_view value) {
    return '/' + std::string(name(one)) + ':' + std::string(value);
  });
  CHECK(option(Option::columns, "2-42") == "/columns:2-42");
  CHECK(option(Option::no_diagnostics) == "/no_diagnostics:");
  spell_options(nullptr);
  CHECK(option(Option::force) == "force");
}
