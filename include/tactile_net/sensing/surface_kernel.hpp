/// @file
/// What one value of the surface's tractions does to the readings.
#pragma once

#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

/// The distinct entries of one block of K, which is a Toeplitz matrix but for rows that are left
/// out: its row of taxel j has value i at lag margin + j stride - i.
struct SurfaceKernel {
  /// The reading at the distance m h from a value of 1 Pa, h = spacing, for m = -(count - 1) ...
  /// count - 1, entry m at index m + count - 1 [reading per Pa].
  std::vector<double> lags{};
  double error = 0.0;  ///< bound of the block's rounding error, in the 2-norm
};

/// The entries of one block of K: for line loads by `sampled_kernel`, for hats by `HatKernel`.
/// O(count); in a layer, integrals besides.
[[nodiscard]] SurfaceKernel surface_kernel(const Channel& channel, Traction component,
                                           const Material& material, const Surface& surface);

}  // namespace tactile_net
