#include "tactile_net/sensing/effects/quantization.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

std::unique_ptr<SensorEffect> converter(int bits, Range range, std::size_t readings) {
  return make_effect(Quantization{.bits = bits, .range = {{Quantity::stress_x, range}}},
                     SensorArray{readings, 1.0, {1.0}, {Quantity::stress_x}});
}

std::vector<double> converted(std::vector<double> readings, int bits, Range range) {
  converter(bits, range, readings.size())->apply({}, readings);
  return readings;
}

}  // namespace

TEST_CASE("a converter is wrong by at most half a step", "[effects][property]") {
  const int bits = GENERATE(1, 2, 3, 8, 12, 16, 32);
  const Range range{.low = -0.7, .high = 1.3};
  const double step = 2.0 / (std::ldexp(1.0, bits) - 1.0);
  CAPTURE(bits);
  std::vector<double> readings;
  for (int i = 0; i <= 1000; ++i) readings.push_back(-0.7 + 2.0 * i / 1000.0);
  const std::vector<double> once = converted(readings, bits, range);
  for (std::size_t i = 0; i < once.size(); ++i)
    CHECK_THAT(once[i], WithinAbs(readings[i], 0.5 * step + 1e-15));
  CHECK(converted(once, bits, range) == once);
}

TEST_CASE("a converter has 2^bits levels, the ends among them", "[effects]") {
  std::vector<double> values;
  for (int i = -10; i <= 1010; ++i) values.push_back(-1.0 + 1.4 * i / 1000.0);
  values = converted(values, 3, {.low = -1.0, .high = 0.4});
  CHECK(std::is_sorted(values.begin(), values.end()));
  values.erase(std::unique(values.begin(), values.end()), values.end());
  CHECK(values.size() == 8);
  CHECK(values.front() == -1.0);
  CHECK(values.back() == 0.4);
}

TEST_CASE("beyond its range a converter saturates", "[effects]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(converted({-infinity, -5.0, 0.0, 1.0, 1e300, infinity}, 4, {.low = 0.1, .high = 0.9}) ==
        std::vector{0.1, 0.1, 0.1, 0.9, 0.9, 0.9});
}

TEST_CASE("a converter does not hide a broken reading", "[effects]") {
  const double broken = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(converted({broken, 0.0}, 12, {.low = 0.0, .high = 1.0}).front()));
}

TEST_CASE("readings beyond a converter's levels are counted", "[effects]") {
  const auto stage = converter(3, {.low = 0.0, .high = 7.0}, 4);
  std::vector<double> inside{0.0, 7.0, 7.4, -0.4};  // half a level beyond is rounding
  stage->apply({}, inside);
  CHECK_FALSE(stage->note());
  std::vector<double> beyond{0.0, 7.6, -0.6, 1.0};
  stage->apply({}, beyond);
  const auto note = stage->note();
  REQUIRE(note);
  CHECK(note->effect == "quantization");
  CHECK(note->cut_off == 2);
  CHECK(note->readings == 4);
}
