#include "tactile_net/elasticity/layer.hpp"

#include <cmath>

#include "elasticity/hooke.hpp"
#include "tactile_net/elasticity/half_plane.hpp"

namespace tactile_net {
namespace {

/// The hyperbolic functions of layer.hpp, each times 4 exp(-2 H): nothing overflows.
struct Scaled {
  Scaled(double thickness, double depth, double wavenumber)
      : H(wavenumber * thickness), a(wavenumber * depth), t(wavenumber * (thickness - depth)) {
    const double near = 2.0 * std::exp(-a);          // of exp(U)
    const double far = 2.0 * std::exp(a - 2.0 * H);  // of exp(a)
    cosh_U = near * (1.0 + std::exp(-2.0 * (H + t)));
    sinh_U = -near * std::expm1(-2.0 * (H + t));
    cosh_a = far * (1.0 + std::exp(-2.0 * a));
    sinh_a = -far * std::expm1(-2.0 * a);
    square = 4.0 * std::exp(-2.0 * H);
  }
  double H, a, t;
  double cosh_U, sinh_U, cosh_a, sinh_a;
  double square;  // of 1
};

/// Amplitudes for k > 0; the imaginary ones (odd in y) without their factor -i.
Stress<double> bonded(Traction component, double nu, const Scaled& f) {
  const auto& [H, a, t, cosh_U, sinh_U, cosh_a, sinh_a, square] = f;
  const double kappa = 3.0 - 4.0 * nu;
  const double m = 1.0 - 2.0 * nu;
  const double n = 2.0 - 2.0 * nu;
  const double cosh_H = 1.0 + std::exp(-2.0 * H);
  const double delta = kappa * cosh_H * cosh_H + (H * H + m * m) * square;
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

Stress<double> frictionless(Traction component, const Scaled& f) {
  const auto& [H, a, t, cosh_U, sinh_U, cosh_a, sinh_a, square] = f;
  const double d = -std::expm1(-4.0 * H) + H * square;
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
    const Scaled f(layer.thickness, depth, k);
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
