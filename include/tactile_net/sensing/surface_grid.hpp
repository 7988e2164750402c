/// @file
/// Where the unknown tractions are: values on rows along y and columns along z, a skin's cells or a
/// line's values, which are one column.
#pragma once

#include <cstddef>

#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// What a traction is beyond the first and the last value of an axis, as far as slopes tell.
enum class Boundary {
  neumann,      ///< as large as there: no slope is counted
  zero_beyond,  ///< 0 one spacing further, as of hats: that slope is counted
};

/// A regular grid of values along y and z.
struct SurfaceGrid {
  std::size_t rows = 0;            ///< along y
  std::size_t columns = 0;         ///< along z; 1 of a line
  double spacing_y = 0.0;          ///< [m], > 0
  double spacing_z = 0.0;          ///< [m], > 0; 1 of a line: its forces are per metre of width
  double centre_y = 0.0;           ///< y of the grid's middle [m]
  double centre_z = 0.0;           ///< z of the grid's middle [m]
  std::size_t margin_rows = 0;     ///< before the first taxel's row, and behind the last one's
  std::size_t margin_columns = 0;  ///< before the first taxel's column, and behind the last one's
  std::size_t stride_rows = 0;     ///< taxel (r, c) lies in the middle of the cell
  std::size_t stride_columns =
      0;  ///< (margin + r stride, margin + c stride); 0: an irregular sensor
  Boundary boundary_y = Boundary::neumann;
  Boundary boundary_z = Boundary::neumann;
  bool rectangles = false;  ///< kernels are of uniform rectangles, not of point loads

  /// Number of values of one component: a skin's cells.
  [[nodiscard]] std::size_t count() const noexcept { return rows * columns; }
  /// Area of a cell [m^2]; of a line its spacing [m].
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

/// The cells around one, at most `rows` and `columns` away to either side, within the grid.
struct CellWindow {
  std::size_t rows = 0;
  std::size_t columns = 0;
};

}  // namespace tactile_net
