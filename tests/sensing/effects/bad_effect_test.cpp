// Set-ups that make no sense are refused with the rule in words.
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/sensing/effects/broken_taxels.hpp"
#include "tactile_net/sensing/effects/crosstalk.hpp"
#include "tactile_net/sensing/effects/gain_error.hpp"
#include "tactile_net/sensing/effects/hysteresis.hpp"
#include "tactile_net/sensing/effects/low_pass.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/effects/offset_error.hpp"
#include "tactile_net/sensing/effects/quantization.hpp"
#include "tactile_net/sensing/effects/sampling.hpp"
#include "tactile_net/sensing/effects/saturation.hpp"
#include "tactile_net/sensing/effects/taxel_noise.hpp"
#include "tactile_net/sensing/effects/temperature.hpp"
#include "tactile_net/sensing/effects/viscoelasticity.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("an effect out of its range is refused with the rule in words", "[effects]") {
  const SensorArray array{2, 1.0, {1.0}, {Quantity::strain_x}};
  constexpr Quantity strain = Quantity::strain_x;
  constexpr Quantity stress = Quantity::stress_x;
  const auto refused = [&](const auto& effect, const std::string& rule) {
    CAPTURE(rule);
    CHECK_THROWS_AS(make_effect(effect, array), std::invalid_argument);
    CHECK_THROWS_WITH(make_effect(effect, array), ContainsSubstring(rule));
  };
  refused(Viscoelasticity{{{-0.1, 1.0}}}, "fraction must be >= 0");
  refused(Viscoelasticity{{{0.1, 0.0}}}, "time must be > 0");
  refused(Viscoelasticity{{{0.5, 1.0}, {0.5, 2.0}}},
          "fractions must add up to less than 1 (got 1)");
  refused(Hysteresis{{{strain, {1.0}}}, {0.0}}, "weight must be > 0");
  refused(Hysteresis{{{strain, {1.0, 1.0}}}, {0.7, 0.7}}, "weights must add up to 1 at most");
  refused(Hysteresis{{{strain, {1.0, 1.0}}}, {0.1}}, "thresholds must be as many as weights");
  refused(Hysteresis{{{strain, {-1.0}}}, {0.1}}, "threshold must be >= 0");
  refused(Hysteresis{{{stress, {1.0}}}, {0.1}}, "strain_x is missing");
  refused(Crosstalk{0.6}, "fraction must be from 0 to 0.5 (got 0.6)");
  refused(Crosstalk{std::nan("")}, "fraction must be from 0 to 0.5");
  refused(GainError{.values = {0.1}}, "values must hold one value per taxel (got 1)");
  refused(GainError{.rms = -0.1}, "rms must be >= 0");
  refused(OffsetError{.values = {{strain, {0.1}}}}, "values must hold one value per taxel");
  refused(OffsetError{.rms = {{strain, -0.1}}}, "rms must be >= 0");
  refused(OffsetError{.rms = {{stress, 0.1}}}, "rms must name every quantity");
  refused(TemperatureDrift{.gain = 1.0, .offset = {{strain, 0.0}}, .change = {{0.0, 1.0}, {1.0}}},
          "change must hold one value per time");
  refused(TemperatureDrift{.gain = 1.0, .change = {{0.0}, {1.0}}},
          "offset must name every quantity");
  refused(LowPass{-1.0}, "time_constant must be >= 0");
  refused(Sampling{-1.0}, "aperture must be >= 0");
  refused(NoiseModel{.rms = {{strain, -1.0}}}, "rms must be >= 0");
  refused(NoiseModel{.rms = {{stress, 1.0}}}, "rms must name every quantity");
  refused(TaxelNoise{.rms = {{strain, {1.0}}}}, "rms must hold one value per taxel");
  refused(TaxelNoise{.rms = {{strain, {1.0, -1.0}}}}, "rms must be >= 0");
  refused(Saturation{{{strain, {1.0, 1.0}}}}, "range must begin below its end");
  refused(Quantization{0, {{strain, {0.0, 1.0}}}}, "bits must be from 1 to 32");
  refused(Quantization{8, {{strain, {1.0, 1.0}}}}, "range must begin below its end");
  refused(StuckTaxels{{2}, {{strain, {1.0}}}}, "index must be less than their count (got 2)");
  refused(StuckTaxels{{1}, {{strain, {}}}}, "values must be as many as indices");
  refused(DeadTaxels{{2}}, "index must be less than their count");
}
