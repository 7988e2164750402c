#include "elasticity/layer.hpp"

#include <cmath>

#include "elasticity/hooke.hpp"
#include "elasticity/stress_amplitudes.hpp"
#include "tactile_net/elasticity/half_plane.hpp"

namespace tactile_net {
std::complex<double> layer_transform(Quantity quantity, Traction component,
                                     const Material& material, double depth,
                                     double wavenumber) noexcept {
  const Layer& layer = *material.layer;
  if (std::abs(wavenumber) * (layer.thickness - depth) > 400.0)  // the base is exp(-800) away
    return half_plane_transform(quantity, component, material, depth, wavenumber);
  const bool normal = component == Traction::normal;
  const double k = std::abs(wavenumber);
  Stress<double> s{};
  if (k == 0.0) {
    // A uniform normal load: uniaxial strain if bonded, uniaxial stress if the base lets it slip. A
    // uniform tangential load: pure shear if bonded, no answer (the pole) if nothing holds it.
    const double nu = material.poisson_ratio;
    const bool is_bonded = layer.base == Base::bonded;
    if (normal)
      s = {1.0, is_bonded ? nu / (1.0 - nu) : 0.0, 0.0};
    else
      s = {0.0, 0.0, is_bonded ? 1.0 : 1.0 - depth / layer.thickness};
  } else if (k * depth < 745.0) {  // beyond it exp(-k depth) is zero
    const LayerFunctions f(layer.thickness, depth, k);
    s = layer.base == Base::bonded ? bonded_amplitudes(component, material.poisson_ratio, f)
                                   : frictionless_amplitudes(component, f);
  }
  const std::complex<double> odd{0.0, wavenumber > 0.0 ? -1.0 : 1.0};
  const std::complex<double> even{1.0, 0.0};
  const std::complex<double> direct = normal ? even : odd;
  const std::complex<double> cross = normal ? odd : even;
  return read(quantity, Stress<std::complex<double>>{direct * s.x, direct * s.y, cross * s.shear},
              material);
}

}  // namespace tactile_net
