/// @file
/// Which cells of a skin touch something: the rule of controllers and of solvers. Private.
#pragma once

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

/// Marks the cells that touch with 1, others with 0: patches of neighbours, by edges or corners,
/// that are `touched` with a peak that is `certain`, widened by a rim. O(cells); no allocation.
///
/// @param p           normal tractions, row after row
/// @param deviations  of each
/// @param marks       one for each cell, as the queue
/// @return how many touch
inline std::size_t mark_touching(std::size_t rows, std::size_t columns, const double* p,
                                 const double* deviations, std::size_t rim_rows,
                                 std::size_t rim_columns, std::uint8_t* marks,
                                 std::uint32_t* queue) noexcept {
  constexpr std::uint8_t above = 2;
  const std::size_t count = rows * columns;
  for (std::size_t i = 0; i < count; ++i)
    marks[i] = p[i] > 0.0 && p[i] > touched * deviations[i] ? above : 0;
  std::size_t found = 0;
  for (std::size_t start = 0; start < count; ++start) {
    if (marks[start] != above) continue;
    bool is_certain = false;
    std::size_t size = 0;
    const auto take = [&](std::size_t cell) {
      marks[cell] = 1;
      is_certain |= p[cell] > certain * deviations[cell];
      queue[size++] = static_cast<std::uint32_t>(cell);
    };
    take(start);
    for (std::size_t at = 0; at < size; ++at) {
      const std::size_t row = queue[at] / columns;
      const std::size_t column = queue[at] % columns;
      for (std::size_t m = row > 0 ? row - 1 : 0; m <= row + 1 && m < rows; ++m)
        for (std::size_t n = column > 0 ? column - 1 : 0; n <= column + 1 && n < columns; ++n)
          if (marks[m * columns + n] == above) take(m * columns + n);
    }
    if (is_certain)
      found += size;
    else
      for (std::size_t at = 0; at < size; ++at) marks[queue[at]] = 0;
  }
  if (found == 0) return 0;
  for (std::size_t row = 0; row < rows; ++row)
    widen(marks + row * columns, columns, 1, rim_columns);
  for (std::size_t column = 0; column < columns; ++column)
    widen(marks + column, rows, columns, rim_rows);
  found = 0;
  for (std::size_t i = 0; i < count; ++i) found += marks[i];
  return found;
}

}  // namespace tactile_net
