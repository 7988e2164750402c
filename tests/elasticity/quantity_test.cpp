#include "tactile_net/elasticity/quantity.hpp"

#include "tactile_net/elasticity/pad_kernel.hpp"
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

TEST_CASE("a tangential load is as odd where a normal one is even", "[quantity]") {
  for (const Quantity quantity : quantities)
    CHECK(is_odd(quantity, Traction::normal) != is_odd(quantity, Traction::tangential));
}

TEST_CASE("the parity of the table is that of the kernels", "[quantity]") {
  const Material material = GENERATE(
      Material{.youngs_modulus = 2e6, .poisson_ratio = 0.4},
      Material{.youngs_modulus = 2e6, .poisson_ratio = 0.4, .layer = Layer{6.0}},
      Material{
          .youngs_modulus = 2e6, .poisson_ratio = 0.4, .layer = Layer{6.0, Base::frictionless}});
  for (const Quantity quantity : quantities)
    for (const Traction component : traction_components) {
      CAPTURE(name(quantity), name(component), material.layer.has_value());
      const PadKernel kernel(quantity, component, material, 1.5);
      const double sign = is_odd(quantity, component) ? -1.0 : 1.0;
      for (const double y : {0.3, 2.0, 400.0}) CHECK(kernel(-y) == sign * kernel(y));
      CHECK(kernel(2.0) != 0.0);
    }
}
