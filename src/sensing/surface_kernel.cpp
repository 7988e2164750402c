#include "tactile_net/sensing/surface_kernel.hpp"

#include <algorithm>
#include <cmath>

#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/elasticity/hat_kernel.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/sensing/aperture.hpp"
#include "tactile_net/sensing/sampled.hpp"

namespace tactile_net {
namespace {

/// Half plane: some ulp of every entry, so that the 1-norm of the lags bounds it. Layer: each lag
/// is off by a share of the half plane's peak, one way as well as the other.
double error_of_line_loads(const std::vector<double>& lags, const Channel& channel,
                           Traction component, const Material& material, const Surface& surface) {
  const double relative = relative_kernel_error(material);
  double sum = 0.0;
  for (const double value : lags) sum += std::abs(value);
  if (!material.layer) return relative * sum;
  double peak = 0.0;
  for (std::size_t i = 0; i < surface.count; ++i)
    peak = std::max(peak,
                    std::abs(half_plane_kernel(channel.quantity, component, material, channel.depth,
                                               static_cast<double>(i) * surface.spacing)));
  return relative * peak * surface.spacing * std::sqrt(static_cast<double>(lags.size()));
}

}  // namespace

SurfaceKernel surface_kernel(const Channel& channel, Traction component, const Material& material,
                             const Surface& surface) {
  const std::size_t n = surface.count;
  SurfaceKernel kernel;
  if (surface.basis == SurfaceBasis::taxels) {
    kernel.lags = sampled_kernel(channel, component, material, n, surface.spacing);
    kernel.error = error_of_line_loads(kernel.lags, channel, component, material, surface);
    return kernel;
  }
  const HatKernel response(channel.quantity, component, material, channel.depth, surface.spacing);
  const Aperture aperture(channel.width, channel.depth);
  kernel.lags.reserve(2 * n - 1);
  for (std::size_t i = 0; i + 1 < 2 * n; ++i) {
    const double u = (static_cast<double>(i) - static_cast<double>(n - 1)) * surface.spacing;
    kernel.lags.push_back(aperture.mean(response, u));
    kernel.error += aperture.mean([&](double y) { return response.error_bound(y); }, u);
  }
  return kernel;
}

}  // namespace tactile_net
