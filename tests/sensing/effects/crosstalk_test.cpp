#include "tactile_net/sensing/effects/crosstalk.hpp"

#include <numeric>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const SensorArray five_taxels_at_two_depths{5, 1.0, {1.0, 2.0}, {Quantity::stress_x}};

std::vector<double> leaked(double fraction, std::vector<double> readings) {
  make_effect(Crosstalk{fraction}, five_taxels_at_two_depths)->apply({}, readings);
  return readings;
}

}  // namespace

TEST_CASE("one taxel's signal leaks to its neighbours, and no further", "[effects]") {
  CHECK(leaked(0.125, {0, 0, 1, 0, 0, 8, 0, 0, 0, 0}) ==
        std::vector<double>{0, 0.125, 0.75, 0.125, 0, 7, 1, 0, 0, 0});
}

TEST_CASE("crosstalk keeps the sum of each channel and a signal that is everywhere the same",
          "[effects][property]") {
  const double fraction = GENERATE(0.01, 0.125, 0.5);
  const std::vector<double> in{1.5, -2.0, 7.0, 0.25, 3.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  const std::vector<double> out = leaked(fraction, in);
  CHECK_THAT(std::accumulate(out.begin(), out.begin() + 5, 0.0), WithinAbs(9.75, 1e-14));
  for (std::size_t i = 5; i < 10; ++i) CHECK(out[i] == 1.0);
}

TEST_CASE("crosstalk is linear and symmetric: taxel i leaks to j as j leaks to i",
          "[effects][property]") {
  std::vector<std::vector<double>> columns;
  for (std::size_t i = 0; i < 5; ++i) {
    std::vector<double> unit(10);
    unit[i] = 1.0;
    columns.push_back(leaked(0.2, unit));
  }
  const std::vector<double> in{1.0, 2.0, -3.0, 0.5, 4.0, 0, 0, 0, 0, 0};
  const std::vector<double> out = leaked(0.2, in);
  for (std::size_t i = 0; i < 5; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < 5; ++j) {
      CHECK_THAT(columns[i][j], WithinAbs(columns[j][i], 1e-16));
      sum += columns[j][i] * in[j];
    }
    CHECK_THAT(out[i], WithinAbs(sum, 1e-14));
  }
}
