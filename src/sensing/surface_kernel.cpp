#include "tactile_net/sensing/surface_kernel.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/sensing/sampled.hpp"

namespace tactile_net {

std::vector<double> surface_kernel(const Channel& channel, Traction component,
                                   const Material& material, const Surface& surface) {
  const std::size_t n = surface.count;
  if (surface.basis == SurfaceBasis::taxels)
    return sampled_kernel(channel, component, material, n, surface.spacing);
  const PadKernel response(channel.quantity, component, material, channel.depth);
  const double h = surface.spacing;
  std::vector<double> kernel;
  for (std::size_t i = 0; i + 1 < 2 * n; ++i) {
    const double u = (static_cast<double>(i) - static_cast<double>(n - 1)) * h;
    const auto f = [&](double t) { return (1 - t) * (response(u - h * t) + response(u + h * t)); };
    kernel.push_back(h * boost::math::quadrature::gauss<double, 20>::integrate(f, 0.0, 1.0));
  }
  return kernel;
}

}  // namespace tactile_net
