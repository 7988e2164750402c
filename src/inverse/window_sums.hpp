/// @file
/// Sums over the windows around the values of a grid. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/sensing/surface_grid.hpp"

namespace tactile_net {

/// In place: of values in a line those at most `reach` away. O(count (2 reach + 1)).
inline void window_sums(double* values, std::size_t count, std::size_t stride, std::size_t reach) {
  if (reach == 0) return;
  std::vector<double> old(count);
  for (std::size_t i = 0; i < count; ++i) old[i] = values[i * stride];
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0.0;
    const std::size_t last = std::min(i + reach, count - 1);
    for (std::size_t k = i - std::min(i, reach); k <= last; ++k) sum += old[k];
    values[i * stride] = sum;
  }
}

/// In place, of one component's values.
inline void window_sums(const SurfaceGrid& grid, const CellWindow& window,
                        std::span<double> values) {
  for (std::size_t row = 0; row < grid.rows; ++row)
    window_sums(values.data() + row * grid.columns, grid.columns, 1, window.columns);
  for (std::size_t column = 0; column < grid.columns; ++column)
    window_sums(values.data() + column, grid.rows, grid.columns, window.rows);
}

}  // namespace tactile_net
