#include "tactile_net/numeric/comparison.hpp"

#include <array>
#include <cmath>

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("the mean absolute error is the thesis' 3.17", "[comparison]") {
  CHECK_THAT(mean_absolute_error(std::array{1.0, 2.0, -3.0}, std::array{1.0, 0.0, 1.0}),
             WithinRel(2.0, 1e-15));
  CHECK(mean_absolute_error({}, {}) == 0.0);
}

TEST_CASE("the relative error does not depend on the unit, however small or large",
          "[comparison]") {
  const double unit = GENERATE(1e-200, 1.0, 1e200);
  CHECK_THAT(relative_l2_error(std::array{3.0 * unit, 4.0 * unit}, std::array{0.0, 5.0 * unit}),
             WithinRel(std::sqrt(10.0) / 5.0, 1e-15));
}

TEST_CASE("there is no relative error without a reference", "[comparison]") {
  CHECK(std::isnan(relative_l2_error(std::array{1.0}, std::array{0.0})));
}

TEST_CASE("the force of sampled tractions is pitch times their sum", "[comparison]") {
  CHECK_THAT(sampled_force(std::array{1.0, 2.0, 3.0}, 0.5), WithinRel(3.0, 1e-15));
}
