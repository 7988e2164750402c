/// @file
/// Where on a surface a load may lie, as windows that cover it at every width. Private.
#pragma once

#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/sensing/surface_grid.hpp"

namespace tactile_net {

/// Values in a row along one axis.
struct AxisRange {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

/// A rectangle of a grid's values: on a line of one column.
struct WindowPlace {
  AxisRange rows{};
  AxisRange columns{};
};

/// Level after level, each of one width: from `narrowest` on each sqrt(2) times the one before, a
/// quarter of the width apart, of a skin squares a third apart, with their middles between the
/// first and the last taxel; then the whole surface.
///
/// A skin's squares narrower than 3.5 depths are half a depth, or where that is more a cell, wider
/// than those before, and as far apart: a contact as wide as a square is cut off by all of them
/// where none has an edge at its own.
///
/// @param narrowest  [m], > 0
/// @param depth      [m], > 0; of a line without effect
/// @param is_line    the grid is a line's: its one column is no width
[[nodiscard]] std::vector<std::vector<WindowPlace>> window_levels(const SurfaceGrid& grid,
                                                                  double narrowest, double depth,
                                                                  bool is_line);

}  // namespace tactile_net
