#include "tactile_net/elasticity/quantity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/elasticity/hat_kernel.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/elasticity/patch_kernel.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("every quantity is found by its name", "[quantity]") {
  for (const Quantity quantity : skin_quantities) CHECK(quantity_named(name(quantity)) == quantity);
}

TEST_CASE("another name names nothing", "[quantity]") {
  CHECK(quantity_named("shear_zy") == std::nullopt);
  CHECK(quantity_named("Stress_x") == std::nullopt);
  CHECK(quantity_named("") == std::nullopt);
}

TEST_CASE("a line finds the names of its own quantities alone", "[quantity]") {
  for (const Quantity quantity : skin_quantities) {
    const bool is_own = std::find(line_quantities.begin(), line_quantities.end(), quantity) !=
                        line_quantities.end();
    CAPTURE(name(quantity));
    CHECK(quantity_named(name(quantity), line_quantities).has_value() == is_own);
  }
}

TEST_CASE("a line's kernels refuse what a skin alone reads and bears", "[quantity]") {
  const Material pad{.youngs_modulus = 2e6, .poisson_ratio = 0.4};
  for (const Quantity quantity : skin_quantities)
    for (const Traction component : skin_tractions) {
      CAPTURE(name(quantity), name(component));
      if (quantity_named(name(quantity), line_quantities) && component != Traction::tangential_z) {
        CHECK_NOTHROW(PadKernel(quantity, component, pad, 1.5));
        CHECK_NOTHROW(HatKernel(quantity, component, pad, 1.5, 0.5));
      } else {
        CHECK_THROWS_AS(PadKernel(quantity, component, pad, 1.5), std::invalid_argument);
        CHECK_THROWS_AS(HatKernel(quantity, component, pad, 1.5, 0.5), std::invalid_argument);
      }
    }
  for (const Quantity quantity : {Quantity::stress_z, Quantity::displacement_x}) {
    CHECK_THROWS_AS(PatchKernel(std::array{quantity}, pad, 1.5), std::invalid_argument);
    CHECK(std::isnan(half_plane_kernel(quantity, Traction::normal, pad, 1.5, 0.3)));
  }
}

TEST_CASE("a line's load has no part across the line", "[quantity]") {
  const Contact rod = RigidContact{.half_width = 1.0, .force = 2.0, .friction = 0.5};
  const Contact sampled =
      SampledTractions{.first = -1.0, .pitch = 1.0, .normal = {1, 2}, .tangential = {0.5, 1}};
  for (const Contact& contact : {rod, sampled}) {
    CHECK(resultant(contact, Traction::tangential_y) != 0.0);
    CHECK(resultant(contact, Traction::tangential_z) == 0.0);
    CHECK(traction(contact, Traction::tangential_z, 0.0) == 0.0);
  }
}

TEST_CASE("strains are the quantities without a unit", "[quantity]") {
  for (const Quantity quantity : skin_quantities)
    CHECK(is_strain(quantity) == (traits(quantity).unit == "1"));
}

TEST_CASE("with y and z exchanged a quantity has the other axis' parity", "[quantity]") {
  constexpr auto exchanged_load = [](Traction component) {
    return component == Traction::normal         ? component
           : component == Traction::tangential_y ? Traction::tangential_z
                                                 : Traction::tangential_y;
  };
  for (const Quantity quantity : skin_quantities) {
    CAPTURE(name(quantity));
    const Quantity other = exchanged(quantity);
    CHECK(exchanged(other) == quantity);
    CHECK(traits(other).kind == traits(quantity).kind);
    for (const Traction component : skin_tractions)
      CHECK(is_odd(other, exchanged_load(component), Axis::z) ==
            is_odd(quantity, component, Axis::y));
  }
}

TEST_CASE("the parity of the table is that of the kernels", "[quantity]") {
  const Material material = GENERATE(
      Material{.youngs_modulus = 2e6, .poisson_ratio = 0.4},
      Material{.youngs_modulus = 2e6, .poisson_ratio = 0.4, .layer = Layer{6.0}},
      Material{
          .youngs_modulus = 2e6, .poisson_ratio = 0.4, .layer = Layer{6.0, Base::frictionless}});
  for (const Quantity quantity : line_quantities)
    for (const Traction component : line_tractions) {
      CAPTURE(name(quantity), name(component), material.layer.has_value());
      const PadKernel kernel(quantity, component, material, 1.5);
      const double sign = is_odd(quantity, component) ? -1.0 : 1.0;
      for (const double y : {0.3, 2.0, 400.0}) CHECK(kernel(-y) == sign * kernel(y));
      CHECK(kernel(2.0) != 0.0);
    }
}
