/// @file
/// What skins read under a load that is round, wave by wave: functions of the distance from its
/// middle times cosines and sines of the angle from the y axis. Private.
///
/// With the amplitudes of docs/internals/space.md (X, L, S, U_x, U_L those under p or q_L; A, B, C
/// those under q_T; T = nu (X + L)) a wave of a normal load has the amplitudes
///
///     X J_0,  S J_1,  (L + T)/2 J_0,  -(L - T)/2 J_2,  U_x J_0,  U_L J_1
///
/// and one of a drag along y
///
///     X J_1,  (S + A)/2 J_0,  -(S - A)/2 J_2,  (L + T)/2 J_1,  (L - T + 2 B)/4 J_1,
///     -(L - T - 2 B)/4 J_3,  U_x J_1,  (U_L + C)/2 J_0,  -(U_L - C)/2 J_2
///
/// since integral_0^2pi exp(i kr cos(w - t)) cos nw dw = 2 pi i^n J_n(kr) cos nt. What a drag along
/// z does is its mirror image across y = z.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "numeric/dual.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// By depth, thickness and nu.
using SkinAmplitude = Dual<3>;

/// Of a normal load, and of a drag.
enum class SkinWave {
  stress_x,
  shear,
  trace,
  deviator,
  strain_x,
  shear_strain,
  strain_trace,
  strain_deviator,
  displacement_x,
  displacement_along,
  drag_stress_x,
  drag_shear,
  drag_shear_turned,
  drag_trace,
  drag_deviator,
  drag_deviator_turned,
  drag_strain_x,
  drag_shear_strain,
  drag_shear_strain_turned,
  drag_strain_trace,
  drag_strain_deviator,
  drag_strain_deviator_turned,
  drag_displacement_x,
  drag_displacement,
  drag_displacement_turned
};
inline constexpr std::size_t skin_wave_count = 25;
inline constexpr std::size_t first_drag_wave = 10;

/// Of the Bessel function.
inline constexpr std::array<std::size_t, skin_wave_count> skin_wave_order = {
    0, 1, 0, 2, 0, 1, 0, 2, 0, 1, 1, 0, 2, 1, 1, 3, 1, 0, 2, 1, 1, 3, 1, 0, 2};
inline constexpr std::size_t most_skin_wave_order = 3;

/// A wave times the cosine, or the sine, of its order times the angle from the y axis.
struct SkinTerm {
  SkinWave wave = SkinWave::stress_x;
  bool sine = false;
  double factor = 1.0;
};
/// @param traction  normal, or along y
[[nodiscard]] const std::vector<SkinTerm>& skin_terms(Quantity quantity, Traction traction);

/// Every wave's amplitude times k, with the sign that i^order gives it.
///
/// @param drags  those of a drag, too; else they are 0
[[nodiscard]] std::array<SkinAmplitude, skin_wave_count> skin_amplitudes(const Material& material,
                                                                         double depth, double k,
                                                                         bool drags);

}  // namespace tactile_net
