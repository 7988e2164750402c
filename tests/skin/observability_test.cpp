#include "tactile_net/skin/observability.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "skin/skin_symbol.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;
using enum Quantity;

namespace {

SkinArray skin_of(std::size_t count, std::vector<Quantity> reads, std::vector<double> depths) {
  return {.rows = count,
          .columns = count,
          .pitch_y = 0.5,
          .pitch_z = 0.5,
          .depths = std::move(depths),
          .reads = std::move(reads)};
}

const Material unit{.youngs_modulus = 1.0, .poisson_ratio = 0.45};

const HiddenWaves* hidden(const SkinObservability& told, WaveDirection direction) {
  const auto found = std::find_if(told.hidden.begin(), told.hidden.end(),
                                  [&](const auto& one) { return one.direction == direction; });
  return found == told.hidden.end() ? nullptr : &*found;
}

}  // namespace

TEST_CASE("the symbol's condition is what was measured in another program",
          "[skin][observability]") {
  // A separate prototype, nu = 0.45: waves of k x = 0.25, 1, 2, 4 at 30 degrees.
  struct Row {
    std::vector<Quantity> reads;
    std::array<double, 4> condition;
  };
  const std::array sizes{0.25, 1.0, 2.0, 4.0};
  for (const auto& [reads, condition] :
       {Row{press_and_drag, {1.6, 5.8, 18.0, 66.0}},
        Row{{stress_x, stress_y, stress_z}, {2.9, 3.3, 6.6, 22.0}},
        Row{{stress_x, stress_y, stress_z, shear_yz}, {2.6, 3.0, 6.4, 23.0}},
        Row{{strain_x, strain_y, strain_z}, {8.7, 13.0, 58.0, 280.0}},
        Row{{displacement_x, displacement_y, displacement_z}, {2.3, 5.2, 15.0, 55.0}}})
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const SkinArray skin = skin_of(4, reads, {1.0});
      const WaveObservability sight = wave_observability(
          skin, unit, {}, sizes[i] * std::cos(std::numbers::pi / 6.0), sizes[i] * 0.5);
      CAPTURE(name(reads[1]), sizes[i]);
      CHECK(sight.rank == 3);
      CHECK_THAT(sight.condition, WithinRel(condition[i], 0.03));
    }
}

TEST_CASE("what no reading sees is named, at any number of depths", "[skin][observability]") {
  for (const std::vector<double>& depths :
       {std::vector{1.0, 1.5}, std::vector{1.0, 1.5, 2.0}, std::vector{1.0, 1.5, 2.0, 2.5}}) {
    const SkinObservability told = observability(skin_of(6, {stress_x}, depths), unit, {});
    const HiddenWaves* any = hidden(told, WaveDirection::any);
    REQUIRE(any != nullptr);
    CHECK(any->curl);
    CHECK_FALSE(any->normal);
    CHECK_FALSE(any->divergence);
    CHECK(any->count() == 1);
    const HiddenWaves* mean = hidden(told, WaveDirection::mean);
    REQUIRE(mean != nullptr);  // both means of q
    CHECK(mean->count() == 2);
    CHECK_FALSE(mean->normal);
  }
  const auto told = [](std::vector<Quantity> reads, double poisson_ratio = 0.45) {
    return observability(skin_of(6, std::move(reads), {1.0}),
                         {.youngs_modulus = 1.0, .poisson_ratio = poisson_ratio}, {});
  };
  CHECK(told(press_and_drag).hidden.empty());
  CHECK(told({displacement_x, displacement_y, displacement_z}).hidden.empty());
  CHECK(told({displacement_x, displacement_y, displacement_z}, 0.5).hidden.empty());
  // Three normal stresses: the curl of waves along an axis, and the mean of q.
  const SkinObservability normal = told({stress_x, stress_y, stress_z});
  CHECK(hidden(normal, WaveDirection::any) == nullptr);
  CHECK(hidden(normal, WaveDirection::diagonal) == nullptr);
  CHECK(hidden(normal, WaveDirection::along_y)->curl);
  CHECK(hidden(normal, WaveDirection::along_z)->curl);
  CHECK(hidden(normal, WaveDirection::mean)->count() == 2);
  // With shear_yz only the mean.
  const SkinObservability more = told({stress_x, stress_y, stress_z, shear_yz});
  REQUIRE(more.hidden.size() == 1);
  CHECK(more.hidden[0].direction == WaveDirection::mean);
  // Two shears: one combination of p and q_L.
  const HiddenWaves mixed = told({shear_xy, shear_xz}).hidden.at(0);
  CHECK(mixed.mixed == 1);
  CHECK_FALSE(mixed.curl);
  // Of an incompressible skin the normal strains add up to nothing.
  CHECK(told({strain_x, strain_y, strain_z}, 0.5).hidden.at(0).direction == WaveDirection::any);
  CHECK(told({strain_x, strain_y, strain_z}).hidden.at(0).direction != WaveDirection::any);
}

TEST_CASE("what only the ends of an array decide is counted", "[skin][observability]") {
  // The three normal stresses: 10 = 9 + 1 of 243 hidden at 9 x 9, none at 8 x 8.
  const std::vector<Quantity> normal{stress_x, stress_y, stress_z};
  const FiniteObservability odd = *observability(skin_of(9, normal, {1.0}), unit, {}).finite;
  CHECK(odd.tractions == 243);
  CHECK(odd.hidden == 10);
  CHECK(odd.hidden_waves == 18);
  CHECK(odd.boundary_only == 8);
  const FiniteObservability even = *observability(skin_of(8, normal, {1.0}), unit, {}).finite;
  CHECK(even.hidden == 0);
  CHECK(even.boundary_only == even.hidden_waves);
  CHECK_THAT(even.condition, WithinRel(1.9e5, 0.03));
  // Measured in another program too.
  for (const auto& [count, condition] :
       {std::pair{8, 5.6e3}, std::pair{9, 8.1e3}, std::pair{12, 1.6e4}}) {
    const FiniteObservability all =
        *observability(skin_of(static_cast<std::size_t>(count), press_and_drag, {1.0}), unit, {})
             .finite;
    CHECK(all.hidden == 0);
    CHECK(all.hidden_waves == 0);
    CHECK_THAT(all.condition, WithinRel(condition, 0.03));
  }
  // One depth of stress_x: two of three.
  CHECK(observability(skin_of(5, {stress_x}, {1.0}), unit, {}).finite->hidden == 50);
}

TEST_CASE("the symbol is what a wide even skin reads of a wave",
          "[skin][observability][property]") {
  // Cells' tractions of one wave, summed by K over a grid that reaches far.
  const SkinArray skin = {.rows = 1, .columns = 1, .depths = {1.0}, .reads = press_and_drag};
  const double k_y = 0.9;
  const double k_z = -0.6;
  const LinearProblem problem =
      make_problem(skin, unit, {.grid = {.spacing = 0.4, .margin = 60.0}});
  const SurfaceGrid& grid = problem.grid;
  const auto symbol = skin_symbol(skin, unit, {}, k_y, k_z);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t u = 0; u < 3; ++u) {
      std::complex<double> sum = 0.0;
      for (std::size_t i = 0; i < grid.count(); ++i) {
        // A wave that ends softly: its ends would be seen.
        const double y = grid.y(i / grid.columns);
        const double z = grid.z(i % grid.columns);
        const double soft = std::exp(-(y * y + z * z) / 800.0);
        sum += problem.kernel(row, u * grid.count() + i) * soft *
               std::exp(std::complex<double>(0.0, k_y * y + k_z * z));
      }
      CHECK(std::abs(sum - symbol[3 * row + u]) <= 5e-3);
    }
}

TEST_CASE("long ripples are known better than short ones", "[skin][observability]") {
  const SkinArray skin = skin_of(16, press_and_drag, {1.0});
  const std::vector<SkinResolution> all = skin_resolutions(skin, unit, {});
  CHECK(all.size() == (256 - 4) / 2 + 4);
  CHECK_THAT(all[0].deviations[0], WithinRel(1.0 / 16.0, 1e-12));  // the mean: stress_x is p
  const double rough = *resolvable_wavelength(all, Traction::normal, 1.0);
  const double fine = *resolvable_wavelength(all, Traction::normal, 10.0);
  CHECK(fine < rough);
  CHECK_FALSE(resolvable_wavelength(all, Traction::normal, 1e-6));
  // What does not show is not resolved at any noise.
  const SkinArray blind = skin_of(16, {stress_x}, {1.0, 2.0});
  const std::vector<SkinResolution> half = skin_resolutions(blind, unit, {});
  CHECK_FALSE(resolvable_wavelength(half, Traction::tangential_y, 1e12));
  CHECK(resolvable_wavelength(half, Traction::normal, 1e3));
  // Of waves along an axis the drags along and across are those along y and z, and the other way
  // round; of an oblique one neither.
  for (const SkinResolution& one : all) {
    if (!std::isfinite(one.wavelength())) continue;
    const bool along_y = one.wavenumber_z == 0.0;
    const bool along_z = one.wavenumber_y == 0.0;
    CHECK_THAT(one.of_wave[0], WithinRel(one.deviations[0], 1e-9));
    if (along_y || along_z) {
      CHECK_THAT(one.of_wave[1], WithinRel(one.deviations[along_y ? 1 : 2], 1e-9));
      CHECK_THAT(one.of_wave[2], WithinRel(one.deviations[along_y ? 2 : 1], 1e-9));
    }
  }
  using enum SkinRipple;
  CHECK_FALSE(resolvable_wavelength(half, drag_across, WaveDirection::any, 1e12));
  // An odd kernel vanishes on waves of two pitches, 1: the next is 8 / 7.
  CHECK_THAT(*resolvable_wavelength(half, drag_along, WaveDirection::along_y, 1e12),
             WithinRel(8.0 / 7.0, 1e-12));
  CHECK(resolvable_wavelength(all, pressure, WaveDirection::any, 10.0) == fine);
  // Readings that are all zero hide everything: one row, and nothing but the drag's shear across
  // it.
  const SkinArray row = {.rows = 5,
                         .columns = 1,
                         .pitch_y = 1.0,
                         .pitch_z = 1.0,
                         .depths = {1.0},
                         .reads = {shear_xz}};
  CHECK(observability(row, unit, {.components = 1}).finite->hidden == 5);
  // With one component, and of taxels anywhere.
  CHECK(skin_resolutions(blind, unit, {.components = 1})[0].deviations[1] ==
        std::numeric_limits<double>::infinity());
  const SkinArray uneven = uneven_skin({{"a", 0.0, 0.0, 1.0, press_and_drag},
                                        {"b", 1.0, 0.2, 1.5, press_and_drag},
                                        {"c", 0.1, 1.1, 1.0, {stress_x}}});
  CHECK(observability(uneven, unit, {}).hidden.empty());
  CHECK_FALSE(observability(uneven, unit, {}).finite.has_value());
  CHECK_FALSE(skin_resolutions(uneven, unit, {}).empty());
  CHECK(name(WaveDirection::along_z) == "along_z");
}
