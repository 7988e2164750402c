#include "tactile_net/sensing/effects/taxel_noise.hpp"

#include <cmath>
#include <vector>

#include "tactile_net/sensing/effects/noise.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const SensorArray three_taxels{3, 1.0, {1.0}, {Quantity::stress_x}};

}  // namespace

TEST_CASE("every taxel has the noise of its own rms", "[effects][property]") {
  const auto stage = make_effect(
      TaxelNoise{.rms = {{Quantity::stress_x, {0.0, 1.0, 5.0}}}, .seed = 3}, three_taxels);
  constexpr int frames = 20000;
  std::vector<double> squares(3);
  double product = 0.0;
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<double> readings(3);
    stage->apply({}, readings);
    for (std::size_t i = 0; i < 3; ++i) squares[i] += readings[i] * readings[i] / frames;
    product += readings[1] * readings[2] / frames;
  }
  const double standard = 5.0 / std::sqrt(frames);  // five standard errors of a mean
  CHECK(squares[0] == 0.0);
  CHECK_THAT(squares[1], WithinAbs(1.0, 1.42 * standard));
  CHECK_THAT(squares[2], WithinAbs(25.0, 25.0 * 1.42 * standard));
  CHECK_THAT(product, WithinAbs(0.0, 5.0 * standard));
}

TEST_CASE("noise of taxels is not the noise of all over again", "[effects]") {
  const auto own = make_effect(
      TaxelNoise{.rms = {{Quantity::stress_x, {1.0, 1.0, 1.0}}}, .seed = 3}, three_taxels);
  double correlation = 0.0;
  constexpr int frames = 3000;
  const auto all =
      make_effect(NoiseModel{.rms = {{Quantity::stress_x, 1.0}}, .seed = 3}, three_taxels);
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<double> a(3);
    std::vector<double> b(3);
    own->apply({}, a);
    all->apply({}, b);
    for (std::size_t i = 0; i < 3; ++i) correlation += a[i] * b[i] / (3.0 * frames);
  }
  CHECK_THAT(correlation, WithinAbs(0.0, 5.0 / std::sqrt(3.0 * frames)));
}
