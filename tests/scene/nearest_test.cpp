#include "tactile_net/scene/nearest.hpp"

#include <vector>

#include "tests/catch.hpp"

using tactile_net::nearest;

TEST_CASE("a slip of the fingers finds the word that was meant", "[nearest]") {
  const std::vector<std::string_view> known{"depth", "depths", "pitch", "youngs_modulus"};
  CHECK(nearest("depht", known) == "depth");
  CHECK(nearest("dept", known) == "depth");
  CHECK(nearest("pich", known) == "pitch");
  CHECK(nearest("young_modulus", known) == "youngs_modulus");
}

TEST_CASE("a different word finds nothing", "[nearest]") {
  const std::vector<std::string_view> known{"depth", "pitch"};
  CHECK(nearest("temperature", known).empty());
  CHECK(nearest("", known).empty());
  CHECK(nearest(std::string(100'000, 'x'), known).empty());
  CHECK(nearest("depth", {}).empty());
}
