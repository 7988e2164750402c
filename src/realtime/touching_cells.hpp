/// @file
/// Which cells of a skin touch something: the rule of controllers and of solvers. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "realtime/touching_loops.hpp"

namespace tactile_net {

/// Share of the strongest contact's force from which another one counts where contacts are judged
/// one by one, as for friction: less is what smoothing leaves beside a strong one.
inline constexpr double least_share = 0.1;

/// Sums over the windows around cells.
struct TouchedWindows {
  std::size_t rows, columns;  ///< that a window reaches to either side
  const double* deviations;   ///< of each sum
  double* sums;               ///< scratch, one for each cell, as the next one
  double* along;
};

/// Marks with 1, among cells that are not marked, the patches of neighbours, by edges or corners,
/// that are `touched` with a peak that is `certainly_touched`. Those without such a peak go to
/// `doubt`.
///
/// @return how many patches are marked anew
inline std::size_t mark_patches(const TouchingLoops& loops, const TouchedGrid& grid,
                                const double* values, const double* deviations, std::uint8_t* marks,
                                std::uint32_t* queue, const auto& doubt) {
  constexpr std::uint8_t above = 2;
  constexpr std::uint8_t doubted = 3;
  const std::size_t count = grid.count();
  if (!loops.mark_above(values, deviations, count, above, marks)) return 0;
  const auto columns = static_cast<std::uint32_t>(grid.columns);
  std::size_t found = 0;
  bool any_doubted = false;
  // What is above lies where the search is, or beyond it.
  const void* next = marks;
  while ((next = std::memchr(
              next, above,
              static_cast<std::size_t>(marks + count - static_cast<const std::uint8_t*>(next)))) !=
         nullptr) {
    bool is_certain = false;
    std::size_t size = 0;
    const auto take = [&](std::size_t cell) {
      marks[cell] = 1;
      is_certain |= values[cell] > certainly_touched * deviations[cell];
      queue[size++] = static_cast<std::uint32_t>(cell);
    };
    take(static_cast<std::size_t>(static_cast<const std::uint8_t*>(next) - marks));
    for (std::size_t at = 0; at < size; ++at) {
      const std::size_t row = queue[at] / columns;
      const std::size_t column = queue[at] % columns;
      for (std::size_t m = row > 0 ? row - 1 : 0; m <= row + 1 && m < grid.rows; ++m)
        for (std::size_t n = column > 0 ? column - 1 : 0; n <= column + 1 && n < grid.columns; ++n)
          if (marks[m * grid.columns + n] == above) take(m * grid.columns + n);
    }
    if (is_certain) {
      ++found;
      continue;
    }
    any_doubted = true;
    for (std::size_t at = 0; at < size; ++at) {
      marks[queue[at]] = doubted;
      doubt(queue[at]);
    }
  }
  if (any_doubted) std::replace(marks, marks + count, doubted, std::uint8_t{0});
  return found;
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
inline Touching mark_touching(const TouchingLoops& loops, const TouchedGrid& grid, const double* p,
                              const double* deviations, const TouchedWindows* windows,
                              std::uint8_t* marks, std::uint32_t* queue, const auto& doubt) {
  const std::size_t count = grid.count();
  std::fill_n(marks, count, std::uint8_t{0});
  Touching found;
  found.patches = mark_patches(loops, grid, p, deviations, marks, queue, [](std::size_t) {});
  if (found.patches > 0) {
    auto* const widened = reinterpret_cast<std::uint8_t*>(queue);  // which is free again
    loops.widen_along(grid, false, grid.rim_columns, marks, widened);
    loops.widen_along(grid, true, grid.rim_rows, widened, marks);
  }
  if (windows != nullptr) {
    loops.leave_out(p, marks, count, windows->sums);
    loops.sum_along(grid, false, windows->columns, windows->sums, windows->along);
    loops.sum_along(grid, true, windows->rows, windows->along, windows->sums);
    found.patches +=
        mark_patches(loops, grid, windows->sums, windows->deviations, marks, queue, doubt);
  }
  std::uint32_t cells = 0;
  for (std::size_t i = 0; i < count; ++i) cells += marks[i];
  found.cells = cells;
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
