#include "tactile_net/elasticity/layer.hpp"

#include <cmath>

#include "elasticity/hooke.hpp"
#include "elasticity/layer_functions.hpp"
#include "tactile_net/elasticity/half_plane.hpp"

namespace tactile_net {
namespace {

/// Amplitudes for k > 0; the imaginary ones (odd in y) without their factor -i.
Stress<double> bonded(Traction component, double nu, const LayerFunctions& f) {
  const auto& [H, a, t, cosh_U, sinh_U, cosh_a, sinh_a, square] = f;
  const double kappa = 3.0 - 4.0 * nu;
  const double m = 1.0 - 2.0 * nu;
  const double n = 2.0 - 2.0 * nu;
  const double delta = f.bonded_determinant(nu);
  const double even = (H * t + 0.5 * (n * n + m * m)) * cosh_a;
  const double odd = (H * t + n * m) * sinh_a;
  const double mixed = 0.5 * a * (kappa * cosh_U + cosh_a);
  if (component == Traction::normal)
    return {(0.5 * kappa * (cosh_U + a * sinh_U) + even + 0.5 * (H + t) * sinh_a) / delta,
            (0.5 * kappa * (cosh_U - a * sinh_U) + (0.5 - m * n - H * t) * cosh_a +
             0.5 * (3.0 * H - t) * sinh_a) /
                delta,
            (mixed - odd) / delta};
  return {
      (odd + mixed) / delta,
      (kappa * (sinh_U - 0.5 * a * cosh_U) + 0.5 * (3.0 * H + t) * cosh_a - odd - sinh_a) / delta,
      (0.5 * kappa * (cosh_U - a * sinh_U) + even - 0.5 * (H + t) * sinh_a) / delta};
}

Stress<double> frictionless(Traction component, const LayerFunctions& f) {
  const auto& [H, a, t, cosh_U, sinh_U, cosh_a, sinh_a, square] = f;
  const double d = f.frictionless_determinant();
  if (component == Traction::normal) {
    const double mean = sinh_U + sinh_a;
    const double wave = a * cosh_U + (H + t) * cosh_a;
    return {0.5 * (mean + wave) / d, 0.5 * (mean - wave) / d,
            0.5 * (a * sinh_U - (H + t) * sinh_a) / d};
  }
  const double wave = a * sinh_U + (H + t) * sinh_a;
  return {0.5 * wave / d, (cosh_U + cosh_a - 0.5 * wave) / d,
          0.5 * (sinh_U - sinh_a - a * cosh_U + (H + t) * cosh_a) / d};
}

}  // namespace

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
    s = layer.base == Base::bonded ? bonded(component, material.poisson_ratio, f)
                                   : frictionless(component, f);
  }
  const std::complex<double> odd{0.0, wavenumber > 0.0 ? -1.0 : 1.0};
  const std::complex<double> even{1.0, 0.0};
  const std::complex<double> direct = normal ? even : odd;
  const std::complex<double> cross = normal ? odd : even;
  return read(quantity, Stress<std::complex<double>>{direct * s.x, direct * s.y, cross * s.shear},
              material);
}

}  // namespace tactile_net
