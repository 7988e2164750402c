#include <cmath>
#include <vector>

#include "tactile_net/sensing/effects/gain_error.hpp"
#include "tactile_net/sensing/effects/offset_error.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

std::vector<double> through(SensorEffect& stage, std::vector<double> readings) {
  stage.apply({}, readings);
  return readings;
}

}  // namespace

TEST_CASE("listed errors of gain and offset are those of the taxels", "[effects]") {
  const SensorArray array{2, 1.0, {1.0, 2.0}, {Quantity::strain_x}};
  CHECK(through(*make_effect(GainError{.values = {0.5, -0.25}}, array), {1.0, 2.0, 4.0, 8.0}) ==
        std::vector{1.5, 1.5, 6.0, 6.0});
  CHECK(through(*make_effect(OffsetError{.values = {{Quantity::strain_x, {0.5, -0.25}}}}, array),
                {1.0, 2.0, 4.0, 8.0}) == std::vector{1.5, 1.75, 4.5, 7.75});
}

TEST_CASE("drawn errors have their rms, stay for ever and are each other's strangers",
          "[effects][property]") {
  const SensorArray array{4000, 1.0, {1.0}, {Quantity::strain_x, Quantity::stress_x}};
  const auto gain = make_effect(GainError{.rms = 0.1, .seed = 5}, array);
  const auto offset = make_effect(
      OffsetError{.rms = {{Quantity::strain_x, 2.0}, {Quantity::stress_x, 3.0}}, .seed = 5}, array);
  const std::vector<double> one(8000, 1.0);
  const std::vector<double> gains = through(*gain, one);
  const std::vector<double> offsets = through(*offset, std::vector<double>(8000));
  CHECK(through(*gain, one) == gains);
  CHECK(through(*offset, std::vector<double>(8000)) == offsets);
  double square = 0.0, strain = 0.0, stress = 0.0, together = 0.0, channels = 0.0;
  for (std::size_t i = 0; i < 4000; ++i) {
    square += std::pow(gains[i] - 1.0, 2) / 4000.0;
    strain += std::pow(offsets[i], 2) / 4000.0;
    stress += std::pow(offsets[4000 + i], 2) / 4000.0;
    together += (gains[i] - 1.0) / 0.1 * offsets[i] / 2.0 / 4000.0;
    channels += (gains[i] - 1.0) * (gains[4000 + i] - 1.0) / 0.01 / 4000.0;
  }
  const double standard = 5.0 / std::sqrt(4000.0);
  CHECK_THAT(square, WithinRel(0.01, 1.42 * standard));
  CHECK_THAT(strain, WithinRel(4.0, 1.42 * standard));
  CHECK_THAT(stress, WithinRel(9.0, 1.42 * standard));
  CHECK_THAT(together, WithinAbs(0.0, standard));
  CHECK_THAT(channels, WithinAbs(0.0, standard));
}
