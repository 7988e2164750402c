#include "elasticity/space/plane_wave.hpp"

#include <cmath>
#include <limits>

#include "elasticity/layer_functions.hpp"
#include "elasticity/space/displacement_amplitudes.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"

namespace tactile_net {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Displacements = DisplacementsOf<double>;

void set(PlaneWave& wave, const Displacements& u, const AntiPlaneAmplitudes& across) {
  wave.normal.displacement_x = u.normal_x;
  wave.normal.displacement_along = u.normal_along;
  wave.tangential.displacement_x = u.tangential_x;
  wave.tangential.displacement_along = u.tangential_along;
  wave.across = across;
}

void half_space(PlaneWave& wave, double nu, double depth, double k) {
  const double m = 1.0 - 2.0 * nu;
  const double n = 2.0 - 2.0 * nu;
  const double a = k * depth;
  const double decay = std::exp(-a);
  if (k == 0.0) return set(wave, {infinity, 0.0, 0.0, infinity}, {1.0, 0.0, infinity});
  if (decay == 0.0) return;  // a may be infinite
  set(wave, {(n + a) * decay / k, (a - m) * decay / k, (m + a) * decay / k, (n - a) * decay / k},
      {decay, decay, 2.0 * decay / k});
}

void layer(PlaneWave& wave, const Material& material, double depth, double k) {
  const double nu = material.poisson_ratio;
  const double h = material.layer->thickness;
  const double rest = h - depth;
  const bool is_bonded = material.layer->base == Base::bonded;
  if (k * rest > 400.0) return half_space(wave, nu, depth, k);  // the base is exp(-800) away
  if (k * depth > 745.0) return;                                // exp(-k depth) is zero
  if (k == 0.0) {
    const double m = 1.0 - 2.0 * nu;
    if (is_bonded)
      return set(wave, {m * rest / (1.0 - nu), 0.0, 0.0, 2.0 * rest}, {1.0, 0.0, 2.0 * rest});
    return set(wave, {(1.0 - nu) * rest, 0.0, 0.0, infinity}, {rest / h, 0.0, infinity});
  }
  const LayerFunctions f(h, depth, k);
  const Displacements u =
      is_bonded ? bonded_displacements(nu, f) : frictionless_displacements(nu, f);
  const double scale = 1.0 / (is_bonded ? f.bonded_determinant(nu) : f.frictionless_determinant());
  // The anti-plane functions over cosh H or sinh H, times exp(-a) top and bottom.
  const double decay = std::exp(-f.a);
  const double cosh_t = decay * (1.0 + std::exp(-2.0 * f.t));
  const double sinh_t = -decay * std::expm1(-2.0 * f.t);
  const double bottom = is_bonded ? 1.0 + std::exp(-2.0 * f.H) : -std::expm1(-2.0 * f.H);
  const double shear = (is_bonded ? cosh_t : sinh_t) / bottom;
  const double shear_along = (is_bonded ? sinh_t : cosh_t) / bottom;
  set(wave,
      {u.normal_x * scale / k, u.normal_along * scale / k, u.tangential_x * scale / k,
       u.tangential_along * scale / k},
      {shear, shear_along, 2.0 * shear_along / k});
}

}  // namespace

PlaneWave plane_wave(const Material& material, double depth, double wavenumber) noexcept {
  const auto stress = [&](Quantity quantity, Traction load) {
    const auto value = pad_transform(quantity, load, material, depth, wavenumber);
    return is_odd(quantity, load) ? -value.imag() : value.real();
  };
  const auto sagittal = [&](Traction load) -> SagittalAmplitudes {
    return {.stress_x = stress(Quantity::stress_x, load),
            .stress_along = stress(Quantity::stress_y, load),
            .shear = stress(Quantity::shear_xy, load)};
  };
  PlaneWave wave{sagittal(Traction::normal), sagittal(Traction::tangential_y), {}};
  if (material.layer)
    layer(wave, material, depth, wavenumber);
  else
    half_space(wave, material.poisson_ratio, depth, wavenumber);
  return wave;
}

}  // namespace tactile_net
