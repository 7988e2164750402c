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

/// Share of the strongest contact's force from which another one counts where contacts are judged
/// one by one, as for friction: less is what smoothing leaves beside a strong one.
inline constexpr double least_share = 0.1;

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
/// @return how many patches are marked anew
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
      ++found;
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

/// What is marked.
struct Touching {
  std::size_t cells = 0;
  std::size_t patches = 0;  ///< before they were widened: no fewer than lie apart
};

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
inline Touching mark_touching(const TouchedGrid& grid, const double* p, const double* deviations,
                              const TouchedWindows* windows, std::uint8_t* marks,
                              std::uint32_t* queue, const auto& doubt) {
  const std::size_t count = grid.count();
  std::fill_n(marks, count, std::uint8_t{0});
  Touching found;
  found.patches = mark_patches(grid, p, deviations, marks, queue, [](std::size_t) {});
  if (found.patches > 0) widen(grid, marks);
  if (windows != nullptr) {
    for (std::size_t i = 0; i < count; ++i) windows->sums[i] = marks[i] != 0 ? 0.0 : p[i];
    for (std::size_t row = 0; row < grid.rows; ++row)
      sum_along(windows->sums + row * grid.columns, windows->along + row * grid.columns,
                grid.columns, 1, windows->columns);
    for (std::size_t column = 0; column < grid.columns; ++column)
      sum_along(windows->along + column, windows->sums + column, grid.rows, grid.columns,
                windows->rows);
    found.patches += mark_patches(grid, windows->sums, windows->deviations, marks, queue, doubt);
  }
  for (std::size_t i = 0; i < count; ++i) found.cells += marks[i];
  return found;
}

/// Numbers the patches of marked cells that touch one another, by an edge or a corner, from 0 on in
/// the order of their first cells. O(cells); no allocation.
///
/// @param labels  of each marked cell the number of its patch; of others nothing
/// @return how many patches there are
inline std::size_t label_patches(const TouchedGrid& grid, const std::uint8_t* marks,
                                 std::uint32_t* labels) noexcept {
  // First each cell points to one of its patch that comes before it, the first one to itself.
  const auto first_of = [&](std::size_t cell) {
    while (labels[cell] != cell) cell = labels[cell] = labels[labels[cell]];
    return cell;
  };
  std::size_t cell = 0;
  for (std::size_t row = 0; row < grid.rows; ++row)
    for (std::size_t column = 0; column < grid.columns; ++column, ++cell) {
      if (marks[cell] == 0) continue;
      const std::size_t above = cell - grid.columns;
      const bool on_left = column > 0;
      std::size_t first = cell;
      if (row > 0 && marks[above] != 0) {
        first = first_of(above);  // the other three are its own neighbours
      } else {
        if (on_left && marks[cell - 1] != 0)
          first = first_of(cell - 1);
        else if (row > 0 && on_left && marks[above - 1] != 0)
          first = first_of(above - 1);
        if (row > 0 && column + 1 < grid.columns && marks[above + 1] != 0) {
          const std::size_t other = first_of(above + 1);
          const std::size_t later = std::max(first, other);
          first = std::min(first, other);
          labels[later] = static_cast<std::uint32_t>(first);
        }
      }
      labels[cell] = static_cast<std::uint32_t>(first);
    }
  std::size_t patches = 0;
  for (cell = 0; cell < grid.count(); ++cell)
    if (marks[cell] != 0)
      labels[cell] =
          labels[cell] == cell ? static_cast<std::uint32_t>(patches++) : labels[labels[cell]];
  return patches;
}

}  // namespace tactile_net
