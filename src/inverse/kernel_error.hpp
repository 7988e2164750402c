/// @file
/// What is known of a kernel's rounding. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

/// How far rounding may have moved one Toeplitz block (`surface_kernel`), in the 2-norm. Half
/// plane: some ulp of every entry, so that the 1-norm of the lags bounds it. Layer: each lag is off
/// by a share of the half plane's peak, one way as well as the other.
[[nodiscard]] inline double kernel_error(const Channel& channel, Traction component,
                                         const Material& material, const Surface& surface,
                                         std::span<const double> kernel) {
  const double relative = relative_kernel_error(material);
  double sum = 0.0;
  for (const double value : kernel) sum += std::abs(value);
  if (!material.layer) return relative * sum;
  double peak = 0.0;
  for (std::size_t i = 0; i < surface.count; ++i)
    peak = std::max(peak,
                    std::abs(half_plane_kernel(channel.quantity, component, material, channel.depth,
                                               static_cast<double>(i) * surface.spacing)));
  return relative * peak * surface.spacing * std::sqrt(static_cast<double>(kernel.size()));
}

}  // namespace tactile_net
