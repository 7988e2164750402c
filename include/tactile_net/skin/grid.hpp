/// @file
/// Where the unknown tractions of a skin are: cells of its surface.
///
/// An unknown is the mean of a traction over a cell [Pa]; a vector of them holds the normal
/// tractions of all cells, row after row, then tangential_y, then tangential_z. Kernels take a
/// cell's force for a point load at its middle, which is the better rule from depths of 1.2 cells
/// on (the cells' forces are then the trapezoidal rule); nearer ones take a uniform rectangle.
#pragma once

#include <cstddef>
#include <optional>

#include "tactile_net/sensing/array.hpp"
#include "tactile_net/skin/array.hpp"

namespace tactile_net {

struct SkinGridOptions {
  /// Side of a cell [m], > 0. It is made smaller until every taxel of a regular skin, or the
  /// outermost taxels of an irregular one, lie on cells' middles. Absent: the pitch or half of the
  /// least depth, whichever is smaller.
  std::optional<double> spacing{};
  /// How far cells' middles reach beyond the outermost taxels [m], >= 0; absent: the least depth.
  std::optional<double> margin{};
};

struct SkinGrid {
  std::size_t rows = 0;            ///< along y
  std::size_t columns = 0;         ///< along z
  double spacing_y = 0.0;          ///< [m], > 0
  double spacing_z = 0.0;          ///< [m], > 0
  double centre_y = 0.0;           ///< y of the grid's middle [m]
  double centre_z = 0.0;           ///< z of the grid's middle [m]
  std::size_t margin_rows = 0;     ///< before the first taxel's row, and behind the last one's
  std::size_t margin_columns = 0;  ///< before the first taxel's column, and behind the last one's
  std::size_t stride_rows = 0;     ///< taxel (r, c) lies in the middle of the cell
  std::size_t stride_columns = 0;  ///< (margin + r stride, margin + c stride); 0: an irregular skin
  bool rectangles = false;         ///< kernels are of uniform rectangles, not of point loads

  /// Number of cells: values of one component.
  [[nodiscard]] std::size_t count() const noexcept { return rows * columns; }
  /// Area of a cell [m^2].
  [[nodiscard]] double area() const noexcept { return spacing_y * spacing_z; }
  /// y of the middles of a row's cells [m].
  [[nodiscard]] double y(std::size_t row) const noexcept {
    return centre_y + centred(row, rows) * spacing_y;
  }
  /// z of the middles of a column's cells [m].
  [[nodiscard]] double z(std::size_t column) const noexcept {
    return centre_z + centred(column, columns) * spacing_z;
  }
};

/// Largest number of cells of a grid: 1024 by 1024.
inline constexpr std::size_t most_cells = std::size_t{1} << 20;

/// @throw std::invalid_argument  the skin is out of range, spacing is not > 0, margin is not >= 0,
///                               or there would be more than `most_cells`
[[nodiscard]] SkinGrid grid_of(const SkinArray& skin, const SkinGridOptions& options = {});

}  // namespace tactile_net
