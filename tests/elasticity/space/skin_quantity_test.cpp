#include "tactile_net/elasticity/space/skin_quantity.hpp"

#include "tactile_net/elasticity/quantity.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("every quantity and every traction of a skin is found by its name", "[skin_quantity]") {
  for (const SkinQuantity quantity : skin_quantities)
    CHECK(skin_quantity_named(name(quantity)) == quantity);
  CHECK(skin_quantity_named("shear_zy") == std::nullopt);
  CHECK(skin_quantity_named("") == std::nullopt);
}

TEST_CASE("a line array's quantities keep their names and units in a skin", "[skin_quantity]") {
  for (const Quantity quantity : quantities) {
    const auto same = skin_quantity_named(name(quantity));
    REQUIRE(same.has_value());
    CHECK((traits(*same).unit == "1") == is_strain(quantity));
    CHECK(is_odd(*same, SkinTraction::normal, Axis::y) == is_odd(quantity, Traction::normal));
    CHECK(is_odd(*same, SkinTraction::tangential_y, Axis::y) ==
          is_odd(quantity, Traction::tangential));
  }
}
