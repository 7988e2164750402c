/// @file
/// A sampled patch by its components, and as a grid. Private.
#pragma once

#include <vector>

#include "tactile_net/skin/load.hpp"

namespace tactile_net {

/// Empty: 0.
[[nodiscard]] inline const std::vector<double>& values(const SampledPatch& patch,
                                                       Traction component) noexcept {
  return component == Traction::normal         ? patch.normal
         : component == Traction::tangential_y ? patch.tangential_y
                                               : patch.tangential_z;
}

/// Its rectangles as cells.
[[nodiscard]] inline SurfaceGrid grid_of(const SampledPatch& patch) noexcept {
  return {.rows = patch.rows,
          .columns = patch.columns,
          .spacing_y = patch.spacing_y,
          .spacing_z = patch.spacing_z,
          .centre_y = patch.y,
          .centre_z = patch.z};
}

}  // namespace tactile_net
