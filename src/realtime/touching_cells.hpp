/// @file
/// Which cells of a skin touch something: the rule of controllers and of solvers. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace tactile_net {

/// Deviations above which a cell may touch, and of a patch's peak, by which it does.
inline constexpr double touched = 2.0;
inline constexpr double certain = 4.0;

/// Widens marks along a line of cells.
inline void widen(std::uint8_t* marks, std::size_t count, std::size_t stride,
                  std::size_t reach) noexcept {
  constexpr std::uint8_t widened = 2;
  const auto pass = [&](bool backwards) {
    std::size_t left = 0;  // cells that the last mark still reaches
    for (std::size_t k = 0; k < count; ++k) {
      std::uint8_t& mark = marks[(backwards ? count - 1 - k : k) * stride];
      if (mark == 1) {
        left = reach;
      } else if (left > 0) {
        mark = widened;
        --left;
      }
    }
  };
  pass(false);
  pass(true);
  for (std::size_t k = 0; k < count; ++k) marks[k * stride] = marks[k * stride] != 0 ? 1 : 0;
}

/// A grid of cells, row after row, and how far what touches is widened.
struct TouchedGrid {
  std::size_t rows, columns;
  std::size_t rim_rows, rim_columns;

  [[nodiscard]] std::size_t count() const noexcept { return rows * columns; }
};

/// Sums over the windows around cells.
struct TouchedWindows {
  std::size_t rows, columns;  ///< that a window reaches to either side
  const double* deviations;   ///< of each sum
  double* sums;               ///< scratch, one for each cell, as the next one
  double* along;
};

/// Adds a value's neighbours along a line, at most `reach` away.
inline void sum_along(const double* values, double* sums, std::size_t count, std::size_t stride,
                      std::size_t reach) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t last = std::min(i + reach, count - 1);
    double sum = 0.0;
    for (std::size_t k = i - std::min(i, reach); k <= last; ++k) sum += values[k * stride];
    sums[i * stride] = sum;
  }
}

/// Marks with 1, among cells that are not marked, the patches of neighbours, by edges or corners,
/// that are `touched` with a peak that is `certain`. Those without such a peak go to `doubt`.
///
/// @return how many cells are marked anew
inline std::size_t mark_patches(const TouchedGrid& grid, const double* values,
                                const double* deviations, std::uint8_t* marks, std::uint32_t* queue,
                                const auto& doubt) {
  constexpr std::uint8_t above = 2;
  constexpr std::uint8_t doubted = 3;
  const std::size_t count = grid.count();
  for (std::size_t i = 0; i < count; ++i)
    if (marks[i] == 0 && values[i] > 0.0 && values[i] > touched * deviations[i]) marks[i] = above;
  std::size_t found = 0;
  for (std::size_t start = 0; start < count; ++start) {
    if (marks[start] != above) continue;
    bool is_certain = false;
    std::size_t size = 0;
    const auto take = [&](std::size_t cell) {
      marks[cell] = 1;
      is_certain |= values[cell] > certain * deviations[cell];
      queue[size++] = static_cast<std::uint32_t>(cell);
    };
    take(start);
    for (std::size_t at = 0; at < size; ++at) {
      const std::size_t row = queue[at] / grid.columns;
      const std::size_t column = queue[at] % grid.columns;
      for (std::size_t m = row > 0 ? row - 1 : 0; m <= row + 1 && m < grid.rows; ++m)
        for (std::size_t n = column > 0 ? column - 1 : 0; n <= column + 1 && n < grid.columns; ++n)
          if (marks[m * grid.columns + n] == above) take(m * grid.columns + n);
    }
    if (is_certain) {
      found += size;
      continue;
    }
    for (std::size_t at = 0; at < size; ++at) {
      marks[queue[at]] = doubted;
      doubt(queue[at]);
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    if (marks[i] == doubted) marks[i] = 0;
  return found;
}

inline void widen(const TouchedGrid& grid, std::uint8_t* marks) noexcept {
  for (std::size_t row = 0; row < grid.rows; ++row)
    widen(marks + row * grid.columns, grid.columns, 1, grid.rim_columns);
  for (std::size_t column = 0; column < grid.columns; ++column)
    widen(marks + column, grid.rows, grid.columns, grid.rim_rows);
}

/// Marks the cells that touch with 1, others with 0: patches of cells, widened by the rim; then,
/// of what is left, patches of windows, which tell of a contact of which no cell is certain: cells
/// that are narrow for their depth share what is told of them. No allocation. O(cells) for patches,
/// however many touch, and for the windows O(cells) times their rows and columns together.
///
/// @param p           normal tractions, row after row
/// @param deviations  of each
/// @param windows     absent: cells alone
/// @param marks       one for each cell, as the queue
/// @param doubt       takes the cells of windows that are above noise, and not certain
/// @return how many touch
inline std::size_t mark_touching(const TouchedGrid& grid, const double* p, const double* deviations,
                                 const TouchedWindows* windows, std::uint8_t* marks,
                                 std::uint32_t* queue, const auto& doubt) {
  const std::size_t count = grid.count();
  std::fill_n(marks, count, std::uint8_t{0});
  if (mark_patches(grid, p, deviations, marks, queue, [](std::size_t) {}) > 0) widen(grid, marks);
  if (windows != nullptr) {
    for (std::size_t i = 0; i < count; ++i) windows->sums[i] = marks[i] != 0 ? 0.0 : p[i];
    for (std::size_t row = 0; row < grid.rows; ++row)
      sum_along(windows->sums + row * grid.columns, windows->along + row * grid.columns,
                grid.columns, 1, windows->columns);
    for (std::size_t column = 0; column < grid.columns; ++column)
      sum_along(windows->along + column, windows->sums + column, grid.rows, grid.columns,
                windows->rows);
    mark_patches(grid, windows->sums, windows->deviations, marks, queue, doubt);
  }
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) found += marks[i];
  return found;
}

}  // namespace tactile_net
