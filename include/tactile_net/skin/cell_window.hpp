/// @file
/// Windows of a skin's cells: the sum over a window is certain where single narrow cells are not.
#pragma once

#include <vector>

#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/sensing/surface_grid.hpp"

namespace tactile_net {

/// The window that reaches `reach` from a cell's middle, no larger than the grid.
/// @param reach  [m], >= 0 and finite
[[nodiscard]] CellWindow window_of(const SurfaceGrid& grid, double reach);

/// A covariance of a skin's tractions.
class CellCovariance : public Covariance {
 public:
  /// Standard deviation of the sum of the normal tractions in the window around each cell, per unit
  /// of `noise_rms` [Pa]. A window of 0 rows and columns gives `deviations` of the normal
  /// tractions.
  [[nodiscard]] virtual std::vector<double> window_deviations(const SurfaceGrid& grid,
                                                              const CellWindow& window) const = 0;
};

}  // namespace tactile_net
