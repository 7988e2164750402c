/// @file
/// Where on a surface a load may lie, as windows that cover it at every width. Private.
#pragma once

#include <cstddef>
#include <numbers>
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

/// How windows of one width, and the widths, follow one another.
struct WindowSteps {
  double apart = 0.25;                 // > 0: of the width, between the middles of two windows
  double wider = std::numbers::sqrt2;  // > 1: each width over the one before
  std::size_t most_widths = 9;         // what is wider takes most of the time
  /// [m] Windows narrower than `wide` are a `step` wider than those before, or a value where that
  /// is more, and as far apart: a contact as wide as they are is cut off by all of them where none
  /// has an edge at its own. 0: the steps are those of the others.
  double wide = 0.0;
  double step = 0.0;
};

/// Level after level, each of one width: from `narrowest` on, with their middles between the first
/// and the last taxel; then the whole surface.
///
/// @param narrowest  [m], > 0
/// @param is_line    the grid is a line's: its one column is no width
[[nodiscard]] std::vector<std::vector<WindowPlace>> window_levels(const SurfaceGrid& grid,
                                                                  double narrowest,
                                                                  const WindowSteps& steps,
                                                                  bool is_line);

}  // namespace tactile_net
