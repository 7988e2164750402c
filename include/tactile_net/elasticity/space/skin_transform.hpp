/// @file
/// Stress, strain and displacement inside a skin, half space or layer, per wave of tractions.
///
/// A wave along e_L = k / |k| splits: the tractions p and q_L cause plane strain in the plane of x
/// and e_L, which is what line arrays have (pad_kernel.hpp), with stress_T =
/// nu (stress_x + stress_L); q_T, across the wave, causes stress_xT, stress_LT and displacement_T
/// alone. docs/internals/space.md has the amplitudes.
#pragma once

#include <complex>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// The integral over y and z of the skin's kernel times exp(-i (k_y y + k_z z)). Correct to some
/// ulp of the half space's largest transform at that depth for every k, displacements in a layer of
/// what a thickness as their unit makes of that: no exponential grows. Regular at nu = 0.5.
///
/// At k = 0 it is the mean of the limit over the directions of k, for periodic grids: stress_y
/// under a normal load on a half space is (1 + 2 nu) / 2. A displacement without a limit is
/// infinite where the pole has even parity (a half space under p; a layer that slips under q), and
/// its principal value 0 where it has odd parity, as are the stresses in a layer that slips under
/// q.
///
/// Preconditions: a material in its range, 0 < depth <= its thickness. Pure, no allocation.
///
/// @param wavenumber_y, wavenumber_z  k [1/m], any sign
[[nodiscard]] std::complex<double> skin_transform(Quantity quantity, Traction component,
                                                  const Material& material, double depth,
                                                  double wavenumber_y,
                                                  double wavenumber_z) noexcept;

}  // namespace tactile_net
