#include "tactile_net/elasticity/half_plane.hpp"

#include <cmath>
#include <numbers>

#include "elasticity/hooke.hpp"
#include "elasticity/stress_amplitudes.hpp"

namespace tactile_net {

namespace {

/// A radial compression 2 cos(angle to the load) / (pi r), resolved along x and y. With the cosine
/// c and the sine s of the angle to the x axis no power of a length can overflow.
Stress<double> kernel(Traction component, double depth, double y) noexcept {
  const double r = std::hypot(depth, y);
  const double c = depth / r;
  const double s = y / r;
  const double radial = 2.0 / std::numbers::pi / r * (component == Traction::normal ? c : s);
  return {radial * c * c, radial * s * s, radial * c * s};
}

Stress<std::complex<double>> transform(Traction component, double depth,
                                       double wavenumber) noexcept {
  const double a = std::abs(wavenumber) * depth;
  if (std::exp(-a) == 0.0) return {};  // a may be infinite: no inf * 0
  const double sign = wavenumber > 0.0 ? 1.0 : wavenumber < 0.0 ? -1.0 : 0.0;
  const std::complex<double> odd{0.0, -sign};
  const Stress<double> s = half_plane_amplitudes(component, a);
  if (component == Traction::normal) return {s.x, s.y, odd * s.shear};
  return {odd * s.x, odd * s.y, s.shear};
}

}  // namespace

double half_plane_kernel(Quantity quantity, Traction component, const Material& material,
                         double depth, double y) noexcept {
  return read(quantity, kernel(component, depth, y), material);
}

std::complex<double> half_plane_transform(Quantity quantity, Traction component,
                                          const Material& material, double depth,
                                          double wavenumber) noexcept {
  return read(quantity, transform(component, depth, wavenumber), material);
}

}  // namespace tactile_net
