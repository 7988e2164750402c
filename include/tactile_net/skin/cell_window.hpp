/// @file
/// A window of a skin's cells: what narrow cells cannot tell one by one their sums do.
#pragma once

#include <cstddef>

#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/skin/grid.hpp"

namespace tactile_net {

/// The cells at most so many rows and columns away, as far as there are any.
struct CellWindow {
  std::size_t rows = 0;
  std::size_t columns = 0;
};

/// The window that reaches so far from a cell's middle [m], >= 0 and finite, and not beyond all
/// cells.
[[nodiscard]] CellWindow window_of(const SkinGrid& grid, double reach);

/// A covariance of a skin's tractions.
class CellCovariance : public Covariance {
 public:
  /// Standard deviation of the sum of the normal tractions in the window around each cell, per unit
  /// of `noise_rms` [Pa]; of no rows and columns `deviations` of the normal tractions.
  [[nodiscard]] virtual std::vector<double> window_deviations(const SkinGrid& grid,
                                                              const CellWindow& window) const = 0;
};

}  // namespace tactile_net
