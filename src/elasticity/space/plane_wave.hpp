/// @file
/// A skin under a plane wave of tractions, in the wave's own frame. Private.
#pragma once

#include <array>
#include <cmath>

#include "elasticity/space/displacement_amplitudes.hpp"
#include "elasticity/stress_amplitudes.hpp"
#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

/// What a traction p or q_L = q along the wave vector of unit amplitude causes in the plane of x
/// and the wave vector: plane strain, as under a line array. Displacements times 2 G.
///
/// Real numbers: under p the shear stress and displacement_along, under q_L the other three, carry
/// a factor -i.
template <class Number>
struct SagittalAmplitudesOf {
  Number stress_x = 0.0;
  Number stress_along = 0.0;
  Number shear = 0.0;
  Number displacement_x = 0.0;
  Number displacement_along = 0.0;
};
using SagittalAmplitudes = SagittalAmplitudesOf<double>;

/// What a traction q_T across the wave vector causes: the stress between the wave vector and the
/// direction across carries a factor -i.
template <class Number>
struct AntiPlaneAmplitudesOf {
  Number shear = 0.0;
  Number shear_along = 0.0;
  Number displacement = 0.0;
};
using AntiPlaneAmplitudes = AntiPlaneAmplitudesOf<double>;

template <class Number>
struct PlaneWaveOf {
  SagittalAmplitudesOf<Number> normal{};
  SagittalAmplitudesOf<Number> tangential{};
  AntiPlaneAmplitudesOf<Number> across{};
};
using PlaneWave = PlaneWaveOf<double>;

/// For k > 0, displacements times 2 G k.
///
/// @param a           k depth
/// @param with_drags  else those under p alone: the others are 0
template <class Number>
PlaneWaveOf<Number> half_space_wave(const Number& nu, const Number& a, bool with_drags = true) {
  using std::exp;
  const Number m = 1.0 - 2.0 * nu;
  const Number n = 2.0 - 2.0 * nu;
  const Number decay = exp(-a);
  const auto sagittal = [&](Traction load, const Number& u_x,
                            const Number& u_along) -> SagittalAmplitudesOf<Number> {
    const Stress<Number> stress = half_plane_amplitudes(load, a);
    return {stress.x, stress.y, stress.shear, u_x, u_along};
  };
  PlaneWaveOf<Number> wave;
  wave.normal = sagittal(Traction::normal, (n + a) * decay, (a - m) * decay);
  if (!with_drags) return wave;
  wave.tangential = sagittal(Traction::tangential_y, (m + a) * decay, (n - a) * decay);
  wave.across = {decay, decay, 2.0 * decay};
  return wave;
}

/// As `half_space_wave`, in a layer.
template <class Number>
PlaneWaveOf<Number> layer_wave(const Number& nu, const LayerFunctionsOf<Number>& f, bool is_bonded,
                               bool with_drags = true) {
  using std::exp;
  using std::expm1;
  const DisplacementsOf<Number> u =
      is_bonded ? bonded_displacements(nu, f) : frictionless_displacements(nu, f);
  const Number scale = 1.0 / (is_bonded ? f.bonded_determinant(nu) : f.frictionless_determinant());
  const auto sagittal = [&](Traction load, const Number& u_x,
                            const Number& u_along) -> SagittalAmplitudesOf<Number> {
    const Stress<Number> stress =
        is_bonded ? bonded_amplitudes(load, nu, f) : frictionless_amplitudes(load, f);
    return {stress.x, stress.y, stress.shear, u_x * scale, u_along * scale};
  };
  PlaneWaveOf<Number> wave;
  wave.normal = sagittal(Traction::normal, u.normal_x, u.normal_along);
  if (!with_drags) return wave;
  wave.tangential = sagittal(Traction::tangential_y, u.tangential_x, u.tangential_along);
  // The anti-plane functions over cosh H or sinh H, times exp(-a) top and bottom.
  const Number decay = exp(-f.a);
  const Number cosh_t = decay * (1.0 + exp(-2.0 * f.t));
  const Number sinh_t = -decay * expm1(-2.0 * f.t);
  const Number bottom = is_bonded ? 1.0 + exp(-2.0 * f.H) : -expm1(-2.0 * f.H);
  const Number along = (is_bonded ? sinh_t : cosh_t) / bottom;
  wave.across = {(is_bonded ? cosh_t : sinh_t) / bottom, along, 2.0 * along};
  return wave;
}

/// The amplitudes of what a round load makes of a wave: functions of the distance times an angle,
/// in the order of layer_table.hpp and with the signs of i^j.
template <class Number>
std::array<Number, 15> round_amplitudes(const PlaneWaveOf<Number>& wave, const Number& nu) {
  const auto across = [&](const SagittalAmplitudesOf<Number>& f) {
    return nu * (f.stress_x + f.stress_along);
  };
  const auto& [p, q, s] = wave;
  const Number deviator = 0.5 * (q.stress_along - across(q));
  return {p.stress_x,
          p.shear,
          0.5 * (p.stress_along + across(p)),
          -0.5 * (p.stress_along - across(p)),
          p.displacement_x,
          p.displacement_along,
          q.stress_x,
          0.5 * (q.shear + s.shear),
          -0.5 * (q.shear - s.shear),
          0.5 * (q.stress_along + across(q)),
          0.5 * (deviator + s.shear_along),
          -0.5 * (deviator - s.shear_along),
          q.displacement_x,
          0.5 * (q.displacement_along + s.displacement),
          -0.5 * (q.displacement_along - s.displacement)};
}

/// @param wavenumber  k >= 0 [1/m]. At 0 an amplitude is the limit where there is one; poles that
///                    carry -i have their principal value 0 and the others infinity.
[[nodiscard]] PlaneWave plane_wave(const Material& material, double depth,
                                   double wavenumber) noexcept;

}  // namespace tactile_net
