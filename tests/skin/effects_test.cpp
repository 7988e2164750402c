#include <cmath>
#include <memory>

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
#include "tactile_net/sensing/signal_path.hpp"
#include "tactile_net/skin/signal_layout.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

using enum Quantity;

const SkinArray three_by_four{.rows = 3,
                              .columns = 4,
                              .pitch_y = 1.0,
                              .pitch_z = 2.0,
                              .depths = {1.0, 2.0},
                              .reads = {stress_x, displacement_z}};

std::vector<double> ramp() {
  std::vector<double> readings(reading_count(three_by_four));
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i] = static_cast<double>(i) + 1.0;
  return readings;
}

std::vector<double> after(const std::unique_ptr<SensorEffect>& effect, std::vector<double> in,
                          const Instant& at = {}) {
  REQUIRE(effect != nullptr);
  effect->apply(at, in);
  return in;
}

}  // namespace

TEST_CASE("a skin's layout: channels, taxels, and who lies beside whom", "[skin][effects]") {
  const SignalLayout layout = signal_layout(three_by_four);
  CHECK(layout.taxels == 12);
  REQUIRE(layout.channels.size() == 4);
  REQUIRE(layout.readings.size() == 48);
  CHECK(layout.readings[25].taxel == 1);
  CHECK(layout.readings[25].channel == 2);
  // 3 rows of 3 pairs and 2 times 4 pairs, four channels; the middle taxels have four.
  CHECK(layout.neighbours.size() == 4 * (9 + 8));
  CHECK(layout.most_neighbours == 4);
  for (const auto& [first, second] : layout.neighbours) {
    const Site a = sites(three_by_four)[first];
    const Site b = sites(three_by_four)[second];
    CHECK(a.channel == b.channel);
    CHECK(std::abs(a.y - b.y) + 0.5 * std::abs(a.z - b.z) == 1.0);
  }
  // The same lattice as loose taxels, one pitch both ways: the same neighbours.
  SkinArray square = three_by_four;
  square.pitch_z = 1.0;
  square.depths = {1.0};
  std::vector<Taxel> taxels;
  for (const Site& site : sites(square))
    if (site.channel == 0) taxels.push_back({"", site.y, site.z, 1.0, square.reads});
  const SignalLayout loose = signal_layout(uneven_skin(taxels));
  CHECK(loose.neighbours.size() == signal_layout(square).neighbours.size());
  CHECK(loose.most_neighbours == 4);
}

TEST_CASE("crosstalk on a skin keeps the sum, and what is the same everywhere", "[skin][effects]") {
  const auto leaks = make_effect(Crosstalk{.fraction = 0.25}, signal_layout(three_by_four));
  const auto in = ramp();
  const auto out = after(leaks, in);
  for (std::size_t c = 0; c < 4; ++c) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 12; ++i) sum += out[12 * c + i] - in[12 * c + i];
    CHECK_THAT(sum, WithinAbs(0.0, 1e-12));
  }
  // One taxel in the middle gives a quarter to each neighbour.
  std::vector<double> one(48);
  one[5] = 1.0;
  const auto spread = after(leaks, one);
  for (const std::size_t i : {1u, 4u, 6u, 9u}) CHECK(spread[i] == 0.25);
  CHECK(spread[5] == 0.0);
  CHECK(after(leaks, std::vector<double>(48, 3.0)) == std::vector<double>(48, 3.0));
  CHECK_THROWS_WITH(make_effect(Crosstalk{.fraction = 0.3}, signal_layout(three_by_four)),
                    "fraction must be from 0 to 0.25 (got 0.3)");
}

TEST_CASE("noise, gains, offsets and the rest know a skin's quantities", "[skin][effects]") {
  const SignalLayout layout = signal_layout(three_by_four);
  const auto in = ramp();
  const PerQuantity<double> rms = {{stress_x, 0.5}, {displacement_z, 0.0}};
  const auto noisy = after(make_effect(NoiseModel{.rms = rms}, layout), in);
  for (std::size_t i = 0; i < 48; ++i) CHECK((noisy[i] == in[i]) == (i >= 24));
  CHECK_THROWS_WITH(make_effect(NoiseModel{.rms = {{stress_x, 0.5}}}, layout),
                    ContainsSubstring("displacement_z is missing"));

  std::vector<double> per_taxel(12);
  per_taxel[7] = 1.0;
  const auto gained = after(make_effect(GainError{.values = per_taxel}, layout), in);
  for (std::size_t i = 0; i < 48; ++i) CHECK(gained[i] == (i % 12 == 7 ? 2.0 : 1.0) * in[i]);
  const PerQuantity<std::vector<double>> offsets = {{stress_x, per_taxel},
                                                    {displacement_z, per_taxel}};
  const auto moved = after(make_effect(OffsetError{.values = offsets}, layout), in);
  for (std::size_t i = 0; i < 48; ++i) CHECK(moved[i] == in[i] + (i % 12 == 7 ? 1.0 : 0.0));
  const auto some = after(make_effect(TaxelNoise{.rms = offsets}, layout), in);
  for (std::size_t i = 0; i < 48; ++i) CHECK((some[i] == in[i]) == (i % 12 != 7));
  CHECK_THROWS_WITH(make_effect(GainError{.values = {1.0}}, layout),
                    ContainsSubstring("hold one value per taxel"));

  const auto dead = after(make_effect(DeadTaxels{{2}}, layout), in);
  for (std::size_t i = 0; i < 48; ++i) CHECK(dead[i] == (i % 12 == 2 ? 0.0 : in[i]));
  const auto stuck = after(
      make_effect(StuckTaxels{{3}, {{stress_x, {7.5}}, {displacement_z, {-1.5}}}}, layout), in);
  CHECK(stuck[3] == 7.5);
  CHECK(stuck[39] == -1.5);

  const auto limited = make_effect(
      Saturation{.range = {{stress_x, {0.0, 20.0}}, {displacement_z, {0.0, 30.0}}}}, layout);
  const auto cut = after(limited, in);
  CHECK(cut[23] == 20.0);
  CHECK(cut[47] == 30.0);
  CHECK(limited->note().value().cut_off == 4 + 18);
  const auto levels = after(
      make_effect(Quantization{.bits = 1,
                               .range = {{stress_x, {0.0, 48.0}}, {displacement_z, {0.0, 48.0}}}},
                  layout),
      in);
  CHECK(levels[10] == 0.0);
  CHECK(levels[40] == 48.0);
  const auto warm =
      after(make_effect(TemperatureDrift{.gain = 0.0,
                                         .offset = {{stress_x, 2.0}, {displacement_z, 0.0}},
                                         .change = {{0.0}, {10.0}}},
                        layout),
            in);
  CHECK(warm[0] == in[0] + 20.0);
  CHECK(warm[30] == in[30]);
}

TEST_CASE("what remembers, remembers a skin's readings", "[skin][effects]") {
  const SignalLayout layout = signal_layout(three_by_four);
  std::vector<std::unique_ptr<SensorEffect>> stages;
  stages.push_back(make_effect(Viscoelasticity{{{0.5, 1.0}}}, layout));
  stages.push_back(make_effect(
      Hysteresis{.thresholds = {{stress_x, {0.0}}, {displacement_z, {1.0}}}, .weights = {1.0}},
      layout));
  stages.push_back(make_effect(LowPass{.time_constant = 1e-3}, layout));
  stages.push_back(make_effect(Sampling{.aperture = 1e-6}, layout));
  SignalPath path(std::move(stages), reading_count(three_by_four));
  CHECK(path.stages() == 4);
  std::vector<double> readings;
  for (int i = 0; i <= 400; ++i) {
    readings = ramp();
    path.apply({.time = 0.05 * i, .since = i == 0 ? 0.0 : 0.05, .opens = true}, readings);
  }
  // Stresses do not creep, displacements double, and stay one threshold behind.
  CHECK_THAT(readings[0], WithinAbs(1.0, 1e-4));
  CHECK_THAT(readings[30], WithinAbs(2.0 * 31.0 - 1.0, 2e-2));
}
