#include "tactile_net/elasticity/pad_kernel.hpp"

#include <numbers>

#include "elasticity/layer.hpp"
#include "elasticity/layer_correction.hpp"
#include "tactile_net/elasticity/half_plane.hpp"

namespace tactile_net {

std::complex<double> pad_transform(Quantity quantity, Traction component, const Material& material,
                                   double depth, double wavenumber) noexcept {
  return material.layer ? layer_transform(quantity, component, material, depth, wavenumber)
                        : half_plane_transform(quantity, component, material, depth, wavenumber);
}

PadKernel::PadKernel(Quantity quantity, Traction component, const Material& material, double depth)
    : quantity_(quantity), component_(component), material_(material), depth_(depth) {
  check_line(quantity);
  check_line(component);
  check(material);
  check_depth(material, depth);
  if (material.layer)
    correction_ = std::make_shared<LayerCorrection>(quantity, component, material, depth);
}

double PadKernel::operator()(double y) const noexcept {
  const double half_plane = half_plane_kernel(quantity_, component_, material_, depth_, y);
  return correction_ ? correction_->corrected(half_plane, y) : half_plane;
}

double relative_kernel_error(const Material& material) noexcept {
  return material.layer ? 1e-13 : 2e-15;
}

double base_error(Quantity quantity, const Material& material) noexcept {
  if (!material.layer) return 0.0;
  const double peak = 2.0 / (std::numbers::pi * material.layer->thickness);
  const double nu = material.poisson_ratio;
  return 1e-13 * (is_strain(quantity) ? (1.0 - nu * nu) / material.youngs_modulus * peak : peak);
}

}  // namespace tactile_net
