#include <cmath>

#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

SkinArray square_lattice(std::size_t rows, std::size_t columns, double depth) {
  return {.rows = rows,
          .columns = columns,
          .pitch_y = 1.0,
          .pitch_z = 1.0,
          .depths = {depth},
          .reads = press_and_drag};
}

/// The same taxels, without a lattice.
SkinArray loose(const SkinArray& skin) {
  std::vector<Taxel> taxels;
  for (const Site& site : sites(skin))
    if (site.channel == 0) taxels.push_back({"", site.y, site.z, site.depth, skin.reads});
  return uneven_skin(taxels);
}

double norm_of_part(const std::vector<double>& values, std::size_t first, std::size_t count) {
  double sum = 0.0;
  for (std::size_t i = first; i < first + count; ++i) sum = std::hypot(sum, values[i]);
  return sum;
}

}  // namespace

TEST_CASE("one cell's readings are its kernel", "[skin]") {
  const SkinArray skin = square_lattice(3, 2, 0.9);
  const Material layer{
      .youngs_modulus = 2.0, .poisson_ratio = 0.4, .layer = Layer{1.3, Base::bonded}};
  for (const SkinGridOptions& options : {SkinGridOptions{}, SkinGridOptions{.spacing = 1.0}}) {
    const SurfaceGrid grid = grid_of(skin, options);
    REQUIRE(grid.rectangles == options.spacing.has_value());
    const SkinKernel kernel(layer, 0.9);
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<double> tractions(3 * grid.count());
      const std::size_t cell = 2 * grid.columns + 1;
      tractions[k * grid.count() + cell] = 3.0;
      const auto readings = sampled_readings(skin, layer, grid, tractions);
      for (std::size_t i = 0; const Site& site : sites(skin)) {
        const double y = site.y - grid.y(2);
        const double z = site.z - grid.z(1);
        const double expected =
            grid.rectangles ? 3.0 * kernel(site.quantity, skin_tractions[k],
                                           Rectangle{grid.spacing_y, grid.spacing_z}, y, z)
                            : 3.0 * grid.area() * kernel(site.quantity, skin_tractions[k], y, z);
        CHECK_THAT(readings[i++], WithinAbs(expected, 1e-14));
      }
    }
  }
}

TEST_CASE("a lattice reads what loose taxels at its places do", "[skin]") {
  const SkinArray skin = square_lattice(4, 3, 2.0);
  const SurfaceGrid grid = grid_of(skin);
  const SkinLoad load = SkinContact{.y = 0.3, .radius = 1.5, .friction = 0.4, .torsion = 0.1};
  const auto tractions = cell_means(std::span(&load, 1), grid);
  const Material half_space{};
  const auto one = sampled_readings(skin, half_space, grid, tractions);
  const auto other = sampled_readings(loose(skin), half_space, grid, tractions);
  for (std::size_t i = 0; i < one.size(); ++i) CHECK_THAT(other[i], WithinAbs(one[i], 1e-16));
  // Normal tractions alone.
  const auto pushed =
      sampled_readings(skin, half_space, grid, std::span(tractions).first(grid.count()));
  SkinContact frictionless = std::get<SkinContact>(load);
  frictionless.friction = frictionless.torsion = 0.0;
  const SkinLoad push = frictionless;
  const auto same = sampled_readings(skin, half_space, grid, cell_means(std::span(&push, 1), grid));
  for (std::size_t i = 0; i < pushed.size(); ++i) CHECK_THAT(same[i], WithinAbs(pushed[i], 1e-17));
}

TEST_CASE("cells' means sampled are near the exact readings, as was measured", "[skin]") {
  // Point loads from depths of 1.2 cells on, rectangles nearer: a sphere of 4 cells' radius.
  struct Bar {
    double depth, normal, shear;
  };
  for (const Bar& bar : {Bar{0.5, 0.035, 0.11}, Bar{2.0, 0.012, 0.016}, Bar{3.0, 0.009, 0.011}}) {
    const SkinArray skin = square_lattice(13, 13, bar.depth);
    const SurfaceGrid grid = grid_of(skin, {.spacing = 1.0, .margin = 3.0});
    const Material material{.poisson_ratio = 0.45};
    const SkinLoad load =
        SkinContact{.y = 0.21, .z = -0.34, .radius = 4.0, .force = 10.0, .friction = 0.4};
    const auto exact = exact_readings(skin, material, std::span(&load, 1));
    auto error = sampled_readings(skin, material, grid, cell_means(std::span(&load, 1), grid));
    for (std::size_t i = 0; i < error.size(); ++i) error[i] -= exact[i];
    CAPTURE(bar.depth, norm_of_part(error, 0, 169) / norm_of_part(exact, 0, 169));
    CHECK(norm_of_part(error, 0, 169) < bar.normal * norm_of_part(exact, 0, 169));
    CHECK(norm_of_part(error, 169, 169) < bar.shear * norm_of_part(exact, 169, 169));
  }
}

TEST_CASE("tractions that do not fit are refused", "[skin]") {
  const SkinArray skin = square_lattice(2, 2, 1.0);
  const SurfaceGrid grid = grid_of(skin);
  CHECK_THROWS_WITH(sampled_readings(skin, Material{}, grid, std::vector<double>(5)),
                    "tractions must hold one value for each cell and component, 49 or 147 (got 5)");
}
