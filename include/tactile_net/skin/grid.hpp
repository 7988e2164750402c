/// @file
/// Where the unknown tractions of a skin are: cells of its surface.
///
/// An unknown is the mean of a traction over a cell [Pa]; a vector of them holds the normal
/// tractions of all cells, row after row, then tangential_y, then tangential_z. Kernels take a
/// cell's force for a point load at its middle, which is the better rule from depths of 1.2 cells
/// on (the cells' forces are then the trapezoidal rule); nearer ones take a uniform rectangle.
#pragma once

#include <cstddef>
#include <optional>

#include "tactile_net/sensing/surface_grid.hpp"
#include "tactile_net/skin/array.hpp"

namespace tactile_net {

struct SkinGridOptions {
  /// Side of a cell [m], > 0. It is made smaller until every taxel of a regular skin, or the
  /// outermost taxels of an irregular one, lie on cells' middles. Absent: the pitch or half of the
  /// least depth, whichever is smaller.
  std::optional<double> spacing{};
  /// How far cells' middles reach beyond the outermost taxels [m], >= 0; absent: the least depth.
  std::optional<double> margin{};
};

/// Largest number of cells of a grid: 1024 by 1024.
inline constexpr std::size_t most_cells = std::size_t{1} << 20;

/// @throw std::invalid_argument  the skin is out of range, spacing is not > 0, margin is not >= 0,
///                               or there would be more than `most_cells`
[[nodiscard]] SurfaceGrid grid_of(const SkinArray& skin, const SkinGridOptions& options = {});

}  // namespace tactile_net
