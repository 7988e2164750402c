#include "calibration/skin_waves.hpp"

#include "elasticity/space/displacement_amplitudes.hpp"
#include "elasticity/stress_amplitudes.hpp"

namespace tactile_net {
namespace {

using Amplitude = SkinAmplitude;
using enum SkinWave;
using Terms = std::array<std::vector<SkinTerm>, skin_quantities.size()>;

/// In the order of the quantities.
const Terms normal_terms = {{
    {{stress_x}},
    {{trace}, {deviator}},
    {{trace}, {deviator, false, -1.0}},
    {{shear}},
    {{shear, true}},
    {{deviator, true}},
    {{strain_x}},
    {{strain_trace}, {strain_deviator}},
    {{strain_trace}, {strain_deviator, false, -1.0}},
    {{shear_strain}},
    {{shear_strain, true}},
    {{strain_deviator, true, 2.0}},
    {{displacement_x}},
    {{displacement_along}},
    {{displacement_along, true}},
}};

const Terms drag_terms = {{
    {{drag_stress_x}},
    {{drag_trace}, {drag_deviator}, {drag_deviator_turned}},
    {{drag_trace}, {drag_deviator, false, -1.0}, {drag_deviator_turned, false, -1.0}},
    {{drag_shear}, {drag_shear_turned}},
    {{drag_shear_turned, true}},
    {{drag_deviator, true}, {drag_deviator_turned, true}},
    {{drag_strain_x}},
    {{drag_strain_trace}, {drag_strain_deviator}, {drag_strain_deviator_turned}},
    {{drag_strain_trace},
     {drag_strain_deviator, false, -1.0},
     {drag_strain_deviator_turned, false, -1.0}},
    {{drag_shear_strain}, {drag_shear_strain_turned}},
    {{drag_shear_strain_turned, true}},
    {{drag_strain_deviator, true, 2.0}, {drag_strain_deviator_turned, true, 2.0}},
    {{drag_displacement_x}},
    {{drag_displacement}, {drag_displacement_turned}},
    {{drag_displacement_turned, true}},
}};

/// What a traction along the wave does to the plane of it and x; displacements times 2 G k.
struct Sagittal {
  Stress<Amplitude> stress{};
  Amplitude u_x{}, u_along{};
};
/// What one across it does besides: the shear stress below it, that along the wave, and the
/// displacement times G k, which is the second.
struct Across {
  Amplitude shear{}, along{};
  Amplitude displacement{};
};

struct PadWaves {
  Sagittal normal{}, drag{};
  Across across{};
};

PadWaves half_space_waves(const Amplitude& nu, const Amplitude& a, bool drags) {
  const Amplitude decay = exp(-a);
  PadWaves waves;
  waves.normal = {half_plane_amplitudes(Traction::normal, a), (2.0 - 2.0 * nu + a) * decay,
                  (a - 1.0 + 2.0 * nu) * decay};
  if (!drags) return waves;
  waves.drag = {half_plane_amplitudes(Traction::tangential_y, a), (1.0 - 2.0 * nu + a) * decay,
                (2.0 - 2.0 * nu - a) * decay};
  waves.across = {decay, decay, decay};
  return waves;
}

PadWaves layer_waves(const Amplitude& nu, const LayerFunctionsOf<Amplitude>& f, bool bonded,
                     bool drags) {
  const auto stress = [&](Traction load) {
    return bonded ? bonded_amplitudes(load, nu, f) : frictionless_amplitudes(load, f);
  };
  const auto u = bonded ? bonded_displacements(nu, f) : frictionless_displacements(nu, f);
  const Amplitude over = bonded ? f.bonded_determinant(nu) : f.frictionless_determinant();
  PadWaves waves;
  waves.normal = {stress(Traction::normal), u.normal_x / over, u.normal_along / over};
  if (!drags) return waves;
  waves.drag = {stress(Traction::tangential_y), u.tangential_x / over, u.tangential_along / over};
  // Over cosh H or sinh H, times exp(-a) top and bottom.
  const Amplitude decay = exp(-f.a);
  const Amplitude cosh_t = decay * (1.0 + exp(-2.0 * f.t));
  const Amplitude sinh_t = -decay * expm1(-2.0 * f.t);
  const Amplitude bottom = bonded ? 1.0 + exp(-2.0 * f.H) : -expm1(-2.0 * f.H);
  waves.across.shear = (bonded ? cosh_t : sinh_t) / bottom;
  waves.across.along = (bonded ? sinh_t : cosh_t) / bottom;
  waves.across.displacement = waves.across.along;
  return waves;
}

}  // namespace

const std::vector<SkinTerm>& skin_terms(Quantity quantity, Traction traction) {
  return (traction == Traction::normal ? normal_terms
                                       : drag_terms)[static_cast<std::size_t>(quantity)];
}

std::array<SkinAmplitude, skin_wave_count> skin_amplitudes(const Material& material, double depth,
                                                           double k, bool drags) {
  const Amplitude x = Amplitude::seed(depth, 0);
  const Amplitude nu = Amplitude::seed(material.poisson_ratio, 2);
  const double modulus = material.youngs_modulus;
  PadWaves waves;
  if (!material.layer || k * (material.layer->thickness - depth) > 400.0) {
    waves = half_space_waves(nu, k * x, drags);
  } else {
    const Amplitude h = Amplitude::seed(material.layer->thickness, 1);
    waves = layer_waves(nu, LayerFunctionsOf<Amplitude>(h, x, k),
                        material.layer->base == Base::bonded, drags);
  }
  std::array<SkinAmplitude, skin_wave_count> all;
  const auto set = [&](SkinWave wave, const Amplitude& value) {
    all[static_cast<std::size_t>(wave)] = value;
  };
  const Amplitude compliance = (1.0 + nu) / modulus;  // 1 / 2 G
  {
    const auto& [stress, u_x, u_along] = waves.normal;
    const Amplitude across = nu * (stress.x + stress.y);
    const Amplitude mean = 0.5 * (stress.y + across);
    const Amplitude half = -0.5 * (stress.y - across);
    set(stress_x, k * stress.x);
    set(shear, k * stress.shear);
    set(trace, k * mean);
    set(deviator, k * half);
    set(strain_x, k * (stress.x - 2.0 * nu * mean) / modulus);
    set(shear_strain, 2.0 * k * compliance * stress.shear);
    set(strain_trace, k * ((1.0 - nu) * mean - nu * stress.x) / modulus);
    set(strain_deviator, k * compliance * half);
    set(displacement_x, compliance * u_x);
    set(displacement_along, compliance * u_along);
  }
  if (!drags) return all;
  const auto& [stress, u_x, u_along] = waves.drag;
  const Amplitude across = nu * (stress.x + stress.y);
  const Amplitude mean = 0.5 * (stress.y + across);
  const Amplitude single = 0.25 * (stress.y - across) + 0.5 * waves.across.along;
  const Amplitude triple = -0.25 * (stress.y - across) + 0.5 * waves.across.along;
  const Amplitude direct = 0.5 * (stress.shear + waves.across.shear);
  const Amplitude turned = -0.5 * (stress.shear - waves.across.shear);
  const Amplitude u_across = 2.0 * waves.across.displacement;
  set(drag_stress_x, k * stress.x);
  set(drag_shear, k * direct);
  set(drag_shear_turned, k * turned);
  set(drag_trace, k * mean);
  set(drag_deviator, k * single);
  set(drag_deviator_turned, k * triple);
  set(drag_strain_x, k * (stress.x - 2.0 * nu * mean) / modulus);
  set(drag_shear_strain, 2.0 * k * compliance * direct);
  set(drag_shear_strain_turned, 2.0 * k * compliance * turned);
  set(drag_strain_trace, k * ((1.0 - nu) * mean - nu * stress.x) / modulus);
  set(drag_strain_deviator, k * compliance * single);
  set(drag_strain_deviator_turned, k * compliance * triple);
  set(drag_displacement_x, compliance * u_x);
  set(drag_displacement, 0.5 * compliance * (u_along + u_across));
  set(drag_displacement_turned, -0.5 * compliance * (u_along - u_across));
  return all;
}

}  // namespace tactile_net
