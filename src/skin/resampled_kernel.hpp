/// @file
/// A given kernel whose cells lie in no rows and columns, on the cells of the chart. Private.
#pragma once

#include <vector>

#include "tactile_net/sensing/surface_grid.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {

/// Each of the chart's cells stands for what the given ones bear when each has the mean over itself
/// of the chart's tractions. So a cell's force and moment are those of the given cells' own
/// tractions, which cause the readings: sums over the chart are theirs to rounding. Cells at the
/// rim that the given ones hardly cover cause nothing.
struct ResampledKernel {
  std::vector<SurfaceCell> cells{};
  /// Readings x (3 cells), of unit tractions on the chart's cells; as the given kernel.
  Matrix kernel{};
};

/// @pre  the skin has a given kernel without rows and columns
/// @throw std::invalid_argument  given cells leave out the surface beside a taxel, lie over one
///                               another, or are turned inside out against the surface
[[nodiscard]] ResampledKernel resampled_kernel(const SkinArray& skin, const SurfaceGrid& grid);

}  // namespace tactile_net
