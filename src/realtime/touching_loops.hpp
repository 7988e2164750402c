/// @file
/// The loops over all cells by which those that touch are found, compiled once for every
/// instruction set. They give the same bits on each. Private.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

/// Deviations above which a cell may touch, and of a patch's peak, by which it does.
inline constexpr double touched = 2.0;
inline constexpr double certainly_touched = 4.0;

/// A grid of cells, row after row, and how far what touches is widened.
struct TouchedGrid {
  std::size_t rows, columns;
  std::size_t rim_rows, rim_columns;

  [[nodiscard]] std::size_t count() const noexcept { return rows * columns; }
};

struct TouchingLoops {
  /// Gives cells that are `touched` and not marked yet this mark; returns whether there are any.
  bool (*mark_above)(const double* values, const double* deviations, std::size_t count,
                     std::uint8_t mark, std::uint8_t* marks) noexcept;
  /// Values of what is not marked; 0 of what is.
  void (*leave_out)(const double* values, const std::uint8_t* marks, std::size_t count,
                    double* left) noexcept;
  /// Sums of the values at most so many places away, before each place first; along columns or
  /// along rows.
  void (*sum_along)(const TouchedGrid& grid, bool along_columns, std::size_t reach,
                    const double* values, double* sums) noexcept;
  /// Marks what lies at most so many places from a mark, each 0 or 1.
  void (*widen_along)(const TouchedGrid& grid, bool along_columns, std::size_t reach,
                      const std::uint8_t* marks, std::uint8_t* widened) noexcept;
};

/// @param set  one that this machine runs
[[nodiscard]] const TouchingLoops& touching_loops(InstructionSet set) noexcept;

}  // namespace tactile_net
