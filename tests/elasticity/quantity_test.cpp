#include "tactile_net/elasticity/quantity.hpp"

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("every quantity is found by its name", "[quantity]") {
  for (const Quantity quantity : quantities) CHECK(quantity_named(name(quantity)) == quantity);
}

TEST_CASE("another name names nothing", "[quantity]") {
  CHECK(quantity_named("stress_z") == std::nullopt);
  CHECK(quantity_named("Stress_x") == std::nullopt);
  CHECK(quantity_named("") == std::nullopt);
}

TEST_CASE("two of the five are strains", "[quantity]") {
  CHECK(is_strain(Quantity::strain_x));
  CHECK(is_strain(Quantity::strain_y));
  CHECK_FALSE(is_strain(Quantity::stress_x));
  CHECK_FALSE(is_strain(Quantity::stress_y));
  CHECK_FALSE(is_strain(Quantity::shear_xy));
}
