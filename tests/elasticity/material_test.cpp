#include "tactile_net/elasticity/material.hpp"

#include <stdexcept>
#include <string>

#include "tests/catch.hpp"
#include "tests/not_finite.hpp"

using namespace tactile_net;

namespace {

std::string refusal_of_material(const Material& material) {
  try {
    check(material);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("both ends of Poisson's range are materials", "[material]") {
  CHECK(refusal_of_material({}).empty());
  CHECK(refusal_of_material({.poisson_ratio = 0.0}).empty());
  CHECK(refusal_of_material({.poisson_ratio = 0.5}).empty());
}

TEST_CASE("a refusal names field, rule and value", "[material]") {
  CHECK(refusal_of_material({.youngs_modulus = 0.0}) == "youngs_modulus must be > 0 (got 0)");
  CHECK(refusal_of_material({.youngs_modulus = -2.5}) == "youngs_modulus must be > 0 (got -2.5)");
  CHECK(refusal_of_material({.youngs_modulus = infinite}) ==
        "youngs_modulus must be finite (got inf)");
  CHECK(refusal_of_material({.youngs_modulus = not_a_number}) ==
        "youngs_modulus must be finite (got nan)");
  CHECK(refusal_of_material({.poisson_ratio = 0.51}) ==
        "poisson_ratio must lie in [0, 0.5] (got 0.51)");
  CHECK(refusal_of_material({.poisson_ratio = -0.1}) ==
        "poisson_ratio must lie in [0, 0.5] (got -0.1)");
  CHECK(refusal_of_material({.poisson_ratio = not_a_number}) ==
        "poisson_ratio must lie in [0, 0.5] (got nan)");
}
