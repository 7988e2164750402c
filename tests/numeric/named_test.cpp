#include "src/numeric/named.hpp"

#include "tests/catch.hpp"

namespace tactile_net {
namespace {

enum class Colour { red, green, blue };

constexpr Named<Colour> all[] = {
    {Colour::red, "red"}, {Colour::green, "green"}, {Colour::blue, "blue"}};
constexpr Named<Colour> without_the_last[] = {{Colour::red, "red"}, {Colour::green, "green"}};
constexpr Named<Colour> without_a_name[] = {
    {Colour::red, "red"}, {Colour::green, ""}, {Colour::blue, "blue"}};
constexpr Named<Colour> out_of_order[] = {
    {Colour::red, "red"}, {Colour::blue, "blue"}, {Colour::green, "green"}};

TEST_CASE("a table that names every enumerator in order is complete, and no other", "[named]") {
  STATIC_REQUIRE(names_all<all>());
  STATIC_REQUIRE_FALSE(names_all<without_the_last>());
  STATIC_REQUIRE_FALSE(names_all<without_a_name>());
  STATIC_REQUIRE_FALSE(names_all<out_of_order>());
}

TEST_CASE("a name leads back to its enumerator", "[named]") {
  for (const Named<Colour>& row : all) {
    CHECK(name_in<all>(row.value) == row.name);
    CHECK(named_in<all>(row.name) == row.value);
  }
  CHECK(named_in<all>("Red") == std::nullopt);
  CHECK(named_in<all>("") == std::nullopt);
}

}  // namespace
}  // namespace tactile_net
