#include "tactile_net/skin/spectral.hpp"

#include <cmath>

#include "tactile_net/skin/forward.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

SkinArray oblong_lattice(std::size_t rows, std::size_t columns, std::vector<double> depths) {
  return {.rows = rows,
          .columns = columns,
          .pitch_y = 1.0,
          .pitch_z = 0.8,
          .depths = std::move(depths),
          .reads = {Quantity::stress_x, Quantity::shear_yz, Quantity::displacement_z}};
}

/// Numbers without a pattern, between -1 and 1.
std::vector<double> noise(std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = std::sin(1e3 * std::sin(static_cast<double>(i + 1)));
  return values;
}

}  // namespace

TEST_CASE("by FFT cells cause what the sum says", "[skin]") {
  const Material half_space{};
  const Material layer{.layer = Layer{2.5, Base::bonded}};
  for (const SkinArray& skin :
       {oblong_lattice(5, 7, {2.0, 1.5}), oblong_lattice(1, 6, {2.0}), oblong_lattice(4, 1, {2.0}),
        oblong_lattice(1, 1, {2.0}), oblong_lattice(3, 3, {0.7})})
    for (const Material& material : {half_space, layer})
      for (const std::size_t components : {1u, 3u}) {
        // Without a margin some taxels lie on the outermost cells.
        const SurfaceGrid grid = grid_of(skin, {.margin = skin.rows == 3 ? 0.0 : 1.5});
        const auto tractions = noise(components * grid.count());
        SpectralSkinModel model(skin, material, grid, components);
        CAPTURE(skin.rows, skin.columns, components);
        for (int again = 0; again < 2; ++again) {
          const auto by_sum = sampled_readings(skin, material, grid, tractions);
          const auto by_fft = model.readings(tractions);
          REQUIRE(by_fft.size() == by_sum.size());
          for (std::size_t i = 0; i < by_sum.size(); ++i)
            CHECK_THAT(by_fft[i], WithinAbs(by_sum[i], 1e-13));
        }
      }
}

TEST_CASE("taxels beside the lattice are refused", "[skin]") {
  const SkinArray skin = oblong_lattice(4, 4, {1.0});
  SurfaceGrid grid = grid_of(skin);
  grid.spacing_y *= 1.1;
  const char* const sentence =
      "the taxels must lie on the lattice of the grid's cells for an FFT: use sampled_readings";
  CHECK_THROWS_WITH(SpectralSkinModel(skin, Material{}, grid), sentence);
  const SkinArray loose = uneven_skin(
      {{"", 0.0, 0.0, 1.0, {Quantity::stress_x}}, {"", 1.0, 0.3, 1.0, {Quantity::stress_x}}});
  CHECK_THROWS_WITH(SpectralSkinModel(loose, Material{}, grid_of(loose)), sentence);
  CHECK_THROWS_WITH(SpectralSkinModel(skin, Material{}, grid_of(skin), 2),
                    "components must be 1 or 3 (got 2)");
  SpectralSkinModel model(skin, Material{}, grid_of(skin), 1);
  CHECK_THROWS_WITH(model.readings(std::vector<double>(3)),
                    ContainsSubstring("tractions must hold one value for each cell"));
}
