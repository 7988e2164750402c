#include "tactile_net/sensing/effects/temperature.hpp"

#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("gain and zero drift by the kelvin of the moment", "[effects]") {
  const SensorArray array{1, 1.0, {1.0}, {Quantity::stress_x, Quantity::strain_x}};
  const auto stage = make_effect(
      TemperatureDrift{.gain = 0.5,
                       .offset = {{Quantity::stress_x, 0.25}, {Quantity::strain_x, -2.0}},
                       .change = {{0.0, 2.0}, {0.0, 4.0}}},
      array);
  const auto at = [&](double t) {
    std::vector<double> readings{8.0, 8.0};
    stage->apply({.time = t}, readings);
    return readings;
  };
  CHECK(at(0.0) == std::vector{8.0, 8.0});
  CHECK(at(1.0) == std::vector{16.5, 12.0});  // 2 K: twice the gain, 0.5 and -4 of offset
  CHECK(at(9.0) == std::vector{25.0, 16.0});  // as at the last knot
}
