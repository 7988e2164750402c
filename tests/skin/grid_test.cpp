#include "tactile_net/skin/grid.hpp"

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

SkinArray even(std::size_t rows, std::size_t columns, double pitch_y, double pitch_z,
               double depth) {
  return {.rows = rows,
          .columns = columns,
          .pitch_y = pitch_y,
          .pitch_z = pitch_z,
          .depths = {depth},
          .reads = {Quantity::stress_x}};
}

}  // namespace

TEST_CASE("taxels of a lattice lie on cells' middles, and the margin is kept", "[skin][property]") {
  struct Case {
    std::size_t rows, columns;
    double pitch_y, pitch_z, depth;
    SkinGridOptions options;
  };
  for (const Case& c : {Case{4, 6, 1.0, 1.0, 2.0, {}}, Case{4, 6, 1.0, 1.5, 0.4, {}},
                        Case{3, 5, 1.0, 3.0, 1.0, {.spacing = 0.7, .margin = 2.2}},
                        Case{2, 2, 0.1, 0.1, 5.0, {.margin = 0.0}}, Case{1, 7, 0.0, 1.0, 1.0, {}},
                        Case{1, 1, 0.0, 0.0, 1.0, {}}, Case{4, 1, 1e-150, 0.0, 2e-150, {}},
                        Case{4, 4, 1e150, 1e150, 2e150, {}}}) {
    const SkinArray skin = even(c.rows, c.columns, c.pitch_y, c.pitch_z, c.depth);
    const SurfaceGrid grid = grid_of(skin, c.options);
    CAPTURE(c.rows, c.columns, c.depth);
    for (const Site& site : sites(skin)) {
      const std::size_t row = grid.margin_rows + site.taxel / c.columns * grid.stride_rows;
      const std::size_t column = grid.margin_columns + site.taxel % c.columns * grid.stride_columns;
      REQUIRE(row < grid.rows);
      REQUIRE(column < grid.columns);
      CHECK_THAT(grid.y(row), WithinAbs(site.y, 1e-15 * c.depth));
      CHECK_THAT(grid.z(column), WithinAbs(site.z, 1e-15 * c.depth));
    }
    const double margin = c.options.margin.value_or(c.depth);
    CHECK(static_cast<double>(grid.margin_rows) * grid.spacing_y >= margin * (1.0 - 1e-12));
    CHECK(static_cast<double>(grid.margin_columns) * grid.spacing_z >= margin * (1.0 - 1e-12));
    CHECK(grid.rows == (c.rows - 1) * grid.stride_rows + 1 + 2 * grid.margin_rows);
    const double most = c.options.spacing.value_or(0.5 * c.depth) * (1.0 + 1e-12);
    CHECK(grid.spacing_y <= most);
    CHECK(grid.spacing_z <= most);
  }
}

TEST_CASE("cells are as wide as half of the depth, or as the pitch", "[skin]") {
  const SurfaceGrid coarse = grid_of(even(4, 4, 3.0, 2.0, 1.0));
  CHECK(coarse.spacing_y == 0.5);
  CHECK(coarse.stride_rows == 6);
  CHECK(coarse.stride_columns == 4);
  const SurfaceGrid dense = grid_of(even(4, 4, 0.25, 0.25, 1.0));
  CHECK(dense.spacing_y == 0.25);
  CHECK(dense.stride_rows == 1);
  CHECK(dense.rows == 4 + 2 * 4);
  CHECK(dense.area() == 0.0625);
}

TEST_CASE("rectangles stand for cells that are near the taxels, as skin arrays measured",
          "[skin]") {
  CHECK_FALSE(grid_of(even(4, 4, 1.0, 1.0, 1.0)).rectangles);
  CHECK(grid_of(even(4, 4, 1.0, 1.0, 1.0), {.spacing = 1.0}).rectangles);
  CHECK(grid_of(even(4, 4, 1.0, 0.5, 1.19), {.spacing = 1.0}).rectangles);
  CHECK_FALSE(grid_of(even(4, 4, 1.0, 1.0, 1.2), {.spacing = 1.0}).rectangles);
}

TEST_CASE("the grid of an uneven skin reaches around all of it", "[skin]") {
  const SkinArray skin = uneven_skin({{"", 1.0, -2.0, 0.5, {Quantity::stress_x}},
                                      {"", 4.0, 5.0, 0.7, {Quantity::stress_x}},
                                      {"", 2.0, 1.0, 0.5, {Quantity::stress_x}}});
  const SurfaceGrid grid = grid_of(skin);
  CHECK(grid.stride_rows == 0);
  CHECK_THAT(grid.y(grid.margin_rows), WithinAbs(1.0, 1e-14));
  CHECK_THAT(grid.y(grid.rows - 1 - grid.margin_rows), WithinAbs(4.0, 1e-14));
  CHECK_THAT(grid.z(grid.margin_columns), WithinAbs(-2.0, 1e-14));
  CHECK_THAT(grid.z(grid.columns - 1 - grid.margin_columns), WithinAbs(5.0, 1e-14));
  CHECK(grid.y(0) <= 0.5);
  CHECK(grid.spacing_y <= 0.25);
}

TEST_CASE("a grid too fine is refused with the count", "[skin]") {
  const SkinArray skin = even(4, 4, 1.0, 1.0, 1.0);
  CHECK_THROWS_WITH(grid_of(skin, {.spacing = 1e-3}),
                    "the surface would have 5001 x 5001 cells, more than 1048576: choose a larger "
                    "spacing or a smaller margin");
  CHECK_THROWS_WITH(grid_of(skin, {.spacing = 0.0}), "spacing must be > 0 (got 0)");
  CHECK_THROWS_WITH(grid_of(skin, {.margin = -1.0}), "margin must be >= 0 and finite (got -1)");
}
