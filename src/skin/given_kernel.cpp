#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "numeric/require.hpp"
#include "skin/curved_kernel.hpp"
#include "skin/resampled_kernel.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {
namespace {

/// How the middles of a lattice's cells move from cell to cell.
class Lattice {
 public:
  explicit Lattice(const GivenKernel& kernel) : kernel_(kernel) {}

  [[nodiscard]] SpaceVector along_rows(std::size_t row, std::size_t column) const {
    const std::size_t before = row > 0 ? row - 1 : row;
    const std::size_t behind = std::min(row + 1, kernel_.rows - 1);
    return combined(1.0 / static_cast<double>(behind - before), middle(behind, column),
                    -1.0 / static_cast<double>(behind - before), middle(before, column));
  }
  [[nodiscard]] SpaceVector along_columns(std::size_t row, std::size_t column) const {
    const std::size_t before = column > 0 ? column - 1 : column;
    const std::size_t behind = std::min(column + 1, kernel_.columns - 1);
    return combined(1.0 / static_cast<double>(behind - before), middle(row, behind),
                    -1.0 / static_cast<double>(behind - before), middle(row, before));
  }
  [[nodiscard]] const SpaceVector& middle(std::size_t row, std::size_t column) const {
    return kernel_.cells[row * kernel_.columns + column].middle.point;
  }

 private:
  const GivenKernel& kernel_;
};

void check_given(const GivenKernel& kernel, std::size_t readings) {
  const bool is_lattice = kernel.rows > 0 || kernel.columns > 0;
  const std::size_t count = is_lattice ? kernel.rows * kernel.columns : kernel.corners.size();
  require(!is_lattice || (kernel.rows >= 2 && kernel.columns >= 2),
          "the cells of a kernel must lie in two rows and two columns at least");
  require(kernel.cells.size() == count, "cells",
          is_lattice ? "be rows * columns" : "be as many as corners are given of",
          kernel.cells.size());
  require(kernel.kernel.rows == readings, "rows of K", "be one for each reading of the skin",
          kernel.kernel.rows);
  require(kernel.kernel.columns == 3 * count, "columns of K", "be three for each cell",
          kernel.kernel.columns);
  double largest = 0.0;
  for (const double entry : kernel.kernel.values) {
    require(std::isfinite(entry), "K holds a number that is not finite");
    largest = std::max(largest, std::abs(entry));
  }
  require(largest > 0.0, "K is 0: the cells cause no reading");
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceCell& cell = kernel.cells[i];
    require(cell.area > 0.0 && std::isfinite(cell.area),
            "cell " + std::to_string(i) + " has no area");
    require(dot(cell.force[0], cell.middle.frame[0]) > 0.5 * cell.area,
            "cell " + std::to_string(i) +
                " is turned inside out: its corners must run counterclockwise seen from outside, "
                "and its frame's x must point into the skin");
  }
  const auto beside = [&](std::size_t a, std::size_t b) {
    require(dot(kernel.cells[a].middle.frame[0], kernel.cells[b].middle.frame[0]) > 0.0,
            "cells " + std::to_string(a) + " and " + std::to_string(b) +
                " lie side by side and face away from one another");
  };
  for (std::size_t row = 0; row < kernel.rows; ++row)
    for (std::size_t column = 0; column < kernel.columns; ++column) {
      const std::size_t at = row * kernel.columns + column;
      if (row + 1 < kernel.rows) beside(at, at + kernel.columns);
      if (column + 1 < kernel.columns) beside(at, at + 1);
    }
}

/// The same with its cells in another order. @param old_place  of the cell at each place
GivenKernel reordered(GivenKernel kernel, std::size_t rows, std::size_t columns,
                      std::span<const std::size_t> old_place) {
  GivenKernel ordered{.from = std::move(kernel.from), .rows = rows, .columns = columns};
  const std::size_t count = old_place.size();
  ordered.kernel = kernel.kernel;
  for (std::size_t i = 0; i < count; ++i) {
    ordered.cells.push_back(kernel.cells[old_place[i]]);
    for (std::size_t reading = 0; reading < kernel.kernel.rows; ++reading)
      for (std::size_t u = 0; u < 3; ++u)
        ordered.kernel(reading, u * count + i) = kernel.kernel(reading, u * count + old_place[i]);
  }
  return ordered;
}

/// With rows along the frames' y, and columns along z.
GivenKernel along_frames(GivenKernel kernel) {
  const Lattice lattice(kernel);
  double y_of_rows = 0.0;
  double z_of_rows = 0.0;
  double y_of_columns = 0.0;
  double z_of_columns = 0.0;
  for (std::size_t row = 0; row < kernel.rows; ++row)
    for (std::size_t column = 0; column < kernel.columns; ++column) {
      const SurfaceFrame& frame = kernel.cells[row * kernel.columns + column].middle.frame;
      y_of_rows += dot(lattice.along_rows(row, column), frame[1]);
      z_of_rows += dot(lattice.along_rows(row, column), frame[2]);
      y_of_columns += dot(lattice.along_columns(row, column), frame[1]);
      z_of_columns += dot(lattice.along_columns(row, column), frame[2]);
    }
  const bool exchange = std::abs(y_of_rows) < std::abs(z_of_rows);
  const bool back_y = (exchange ? y_of_columns : y_of_rows) < 0.0;
  const bool back_z = (exchange ? z_of_rows : z_of_columns) < 0.0;
  if (!exchange && !back_y && !back_z) return kernel;
  const std::size_t rows = exchange ? kernel.columns : kernel.rows;
  const std::size_t columns = exchange ? kernel.rows : kernel.columns;
  std::vector<std::size_t> old_place;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t y = back_y ? rows - 1 - row : row;
      const std::size_t z = back_z ? columns - 1 - column : column;
      old_place.push_back(exchange ? z * kernel.columns + y : y * kernel.columns + z);
    }
  return reordered(std::move(kernel), rows, columns, old_place);
}

/// Where a point is on the lattice, in cells from its first one's middle.
/// @param at  the nearest cell
std::array<double, 2> lattice_place(const GivenKernel& kernel, const SpaceVector& point,
                                    std::size_t at) {
  const std::size_t row = at / kernel.columns;
  const std::size_t column = at % kernel.columns;
  const Lattice lattice(kernel);
  const SpaceVector y = lattice.along_rows(row, column);
  const SpaceVector z = lattice.along_columns(row, column);
  const SpaceVector from = combined(1.0, point, -1.0, kernel.cells[at].middle.point);
  const double yy = dot(y, y);
  const double yz = dot(y, z);
  const double zz = dot(z, z);
  const double area = yy * zz - yz * yz;
  const double by_y = (zz * dot(from, y) - yz * dot(from, z)) / area;
  const double by_z = (yy * dot(from, z) - yz * dot(from, y)) / area;
  return {static_cast<double>(row) + by_y, static_cast<double>(column) + by_z};
}

}  // namespace

SurfaceCell quadrilateral(const std::array<SpaceVector, 4>& corners, const SurfaceFrame& frame) {
  // The area vector of the rim is that of any surface in it.
  const SpaceVector twice = cross(combined(1.0, corners[2], -1.0, corners[0]),
                                  combined(1.0, corners[3], -1.0, corners[1]));
  const SpaceVector three =
      combined(1.0, combined(1.0, corners[0], 1.0, corners[1]), 1.0, corners[2]);
  const SpaceVector middle = corners[2] == corners[3] ? multiple(1.0 / 3.0, three)
                                                      : combined(0.25, three, 0.25, corners[3]);
  SurfaceCell cell{.middle = {.point = middle, .frame = frame}, .area = 0.5 * length(twice)};
  cell.first_moment = multiple(cell.area, middle);
  cell.force = {multiple(-0.5, twice), multiple(cell.area, frame[1]),
                multiple(cell.area, frame[2])};
  for (std::size_t u = 0; u < 3; ++u) cell.moment[u] = cross(middle, cell.force[u]);
  return cell;
}

std::size_t nearest_cell(std::span<const SurfaceCell> cells, const SpaceVector& point) {
  const auto from = [&](const SurfaceCell& cell) {
    return length(combined(1.0, cell.middle.point, -1.0, point));
  };
  const auto nearest = std::min_element(
      cells.begin(), cells.end(),
      [&](const SurfaceCell& a, const SurfaceCell& b) { return from(a) < from(b); });
  return static_cast<std::size_t>(nearest - cells.begin());
}

SurfaceGrid given_grid(const SkinArray& skin) {
  const GivenKernel& kernel = *skin.curved->given;
  const Lattice lattice(kernel);
  double y = 0.0;
  double z = 0.0;
  double area = 0.0;
  for (std::size_t row = 0; row < kernel.rows; ++row)
    for (std::size_t column = 0; column < kernel.columns; ++column) {
      y += length(lattice.along_rows(row, column));
      z += length(lattice.along_columns(row, column));
      area += kernel.cells[row * kernel.columns + column].area;
    }
  const auto count = static_cast<double>(kernel.cells.size());
  const double scale = std::sqrt(area * count / (y * z));
  return {.rows = kernel.rows,
          .columns = kernel.columns,
          .spacing_y = scale * y / count,
          .spacing_z = scale * z / count};
}

SkinArray with_kernel(const SkinArray& skin, GivenKernel kernel) {
  require(skin.curved != nullptr, "a kernel from a file is of a curved skin");
  check_given(kernel, reading_count(skin));
  CurvedSkin curved = *skin.curved;
  if (kernel.rows == 0) {
    curved.given = std::make_shared<const GivenKernel>(std::move(kernel));
    SkinArray array = skin;
    array.curved = std::make_shared<const CurvedSkin>(std::move(curved));
    return array;
  }
  curved.given = std::make_shared<const GivenKernel>(along_frames(std::move(kernel)));
  const GivenKernel& given = *curved.given;
  SkinArray placed = skin;
  placed.curved = std::make_shared<const CurvedSkin>(curved);
  const SurfaceGrid grid = given_grid(placed);
  const double depth = least_depth(skin);
  std::vector<Taxel> taxels = skin.taxels;
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    const SurfacePlace& above = curved.above[i];
    const std::size_t cell = nearest_cell(given.cells, above.point);
    require(dot(given.cells[cell].middle.frame[0], above.frame[0]) > 0.0,
            "the cell above taxel " + taxels[i].name +
                " is turned inside out: its corners must run counterclockwise seen from outside");
    const auto [row, column] = lattice_place(given, above.point, cell);
    const bool inside = row > -0.6 && column > -0.6 &&
                        row < static_cast<double>(given.rows) - 0.4 &&
                        column < static_cast<double>(given.columns) - 0.4;
    // Millimetres taken for metres make one huge cell, far outside, stand above all taxels.
    const SurfaceCell& its = given.cells[cell];
    const double outside =
        dot(combined(1.0, above.point, -1.0, its.middle.point), its.middle.frame[0]);
    const bool near = std::abs(outside) < depth + 0.5 * std::sqrt(its.area);
    require(inside && near,
            "taxel " + taxels[i].name +
                " lies below none of the kernel's cells: are they in metres, and in the "
                "sensor's axes?");
    taxels[i].y = (row - 0.5 * static_cast<double>(given.rows - 1)) * grid.spacing_y;
    taxels[i].z = (column - 0.5 * static_cast<double>(given.columns - 1)) * grid.spacing_z;
  }
  SkinArray array = uneven_skin(std::move(taxels));
  array.curved = placed.curved;
  return array;
}

std::vector<SurfaceCell> cells_of(const SkinArray& skin, const SurfaceGrid& grid) {
  require(skin.curved != nullptr, "cells in space are of a curved skin");
  if (!skin.curved->given) return skin.curved->surface.cells(grid);
  return has_own_cells(skin) ? skin.curved->given->cells : resampled_kernel(skin, grid).cells;
}

bool has_own_cells(const SkinArray& skin) noexcept {
  return skin.curved && skin.curved->given && skin.curved->given->rows > 0;
}

SkinArray with_kernel(SkinArray skin, CurvedKernel kernel) {
  require(skin.curved != nullptr, "a kernel by name is of a curved skin");
  CurvedSkin curved = *skin.curved;
  curved.kernel = kernel;
  skin.curved = std::make_shared<const CurvedSkin>(std::move(curved));
  return skin;
}

}  // namespace tactile_net
