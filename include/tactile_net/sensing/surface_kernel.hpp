/// @file
/// What one value of the surface's tractions does to the readings.
#pragma once

#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

/// The reading at the distance m h from a value of 1 Pa, h = spacing, m = -(count - 1) ...
/// count - 1, entry m at index m + count - 1 [reading per Pa]: the distinct entries of one block of
/// K, whose row of taxel j has the value i at m = margin + j stride - i.
///
/// Of line loads `sampled_kernel`; of hats the exact integral, see `HatKernel`.
[[nodiscard]] std::vector<double> surface_kernel(const Channel& channel, Traction component,
                                                 const Material& material, const Surface& surface);

}  // namespace tactile_net
