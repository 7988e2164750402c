#include "tactile_net/sensing/effects/quantization.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("a converter is wrong by at most half a step", "[effects][property]") {
  const int bits = GENERATE(1, 2, 3, 8, 12, 16, 32);
  const Converter converter{.bits = bits, .low = -0.7, .high = 1.3};
  const double step = 2.0 / (std::ldexp(1.0, bits) - 1.0);
  CAPTURE(bits);
  for (int i = 0; i <= 1000; ++i) {
    const double reading = -0.7 + 2.0 * i / 1000.0;
    std::array value{reading};
    quantize(value, converter);
    CHECK_THAT(value[0], WithinAbs(reading, 0.5 * step + 1e-15));
    std::array again = value;
    quantize(again, converter);
    CHECK(again == value);
  }
}

TEST_CASE("a converter has 2^bits levels, the ends among them", "[effects]") {
  const Converter converter{.bits = 3, .low = -1.0, .high = 0.4};
  std::vector<double> values;
  for (int i = -10; i <= 1010; ++i) values.push_back(-1.0 + 1.4 * i / 1000.0);
  quantize(values, converter);
  CHECK(std::is_sorted(values.begin(), values.end()));
  values.erase(std::unique(values.begin(), values.end()), values.end());
  CHECK(values.size() == 8);
  CHECK(values.front() == -1.0);
  CHECK(values.back() == 0.4);
}

TEST_CASE("beyond its range a converter saturates", "[effects]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Converter converter{.bits = 4, .low = 0.1, .high = 0.9};
  std::array values{-infinity, -5.0, 0.0, 1.0, 1e300, infinity};
  quantize(values, converter);
  CHECK(values == std::array{0.1, 0.1, 0.1, 0.9, 0.9, 0.9});
}

TEST_CASE("a converter does not hide a broken reading", "[effects]") {
  std::array values{std::numeric_limits<double>::quiet_NaN()};
  quantize(values, {});
  CHECK(std::isnan(values[0]));
}

TEST_CASE("readings beyond a converter's levels are counted", "[effects]") {
  const SensorArray array{4, 1.0, {1.0}, {Quantity::stress_x}};
  const auto stage = make_effect(Converter{.bits = 3, .low = 0.0, .high = 7.0}, array);
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
