#include "tactile_net/sensing/effects/broken_taxels.hpp"

#include <array>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("a dead taxel reads zero, the others do not change", "[effects]") {
  std::array values{1.0, 2.0, 3.0, 4.0};
  kill(values, std::array<std::size_t, 3>{3, 1, 3});
  CHECK(values == std::array{1.0, 0.0, 3.0, 0.0});
  kill(values, {});
  CHECK(values == std::array{1.0, 0.0, 3.0, 0.0});
}

TEST_CASE("a stuck taxel reads what it is stuck at, in every channel its own", "[effects]") {
  const SensorArray array{3, 1.0, {1.0}, {Quantity::stress_x, Quantity::strain_x}};
  const auto stage = make_effect(
      StuckTaxels{.indices = {2, 0},
                  .values = {{Quantity::stress_x, {5.0, 6.0}}, {Quantity::strain_x, {7.0, 8.0}}}},
      array);
  std::vector<double> readings{1.0, 2.0, 3.0, 1.5, 2.5, 3.5};
  stage->apply({}, readings);
  CHECK(readings == std::vector{6.0, 2.0, 5.0, 8.0, 2.5, 7.0});
}
