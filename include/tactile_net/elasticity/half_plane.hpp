/// @file
/// Stress and strain below the surface of an elastic half plane under a line load.
///
/// Frame: x points into the material, y along the surface, x = 0 is the surface. Plane strain,
/// small strain, compression positive. `depth` is x [m] > 0, `y` [m] is measured from the load.
/// With r^2 = x^2 + y^2, a unit force per length gives (Johnson 1985, 2.2-2.3; thesis 2.3-2.10)
///
///                 normal load             tangential load
///     stress_x    2 x^3   / (pi r^4)      2 x^2 y / (pi r^4)
///     stress_y    2 x y^2 / (pi r^4)      2 y^3   / (pi r^4)
///     shear_xy    2 x^2 y / (pi r^4)      2 x y^2 / (pi r^4)
///
/// and the strains by Hooke's law for plane strain,
///
///     strain_x = ((1 - nu^2) stress_x - nu (1 + nu) stress_y) / E,  strain_y with x, y exchanged.
///
/// Preconditions (depth > 0, material in its range, a component out of `line_tractions`) are
/// written here and checked by whoever builds a matrix of these, not in each call. A quantity that
/// is none of `line_quantities` gives NaN. Pure functions: thread-safe, no allocation.
#pragma once

#include <complex>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// The reading caused by a unit line load at the origin [Pa / (N/m) for stress, 1 / (N/m) for
/// strain]. Stresses are correct to a few ulp, strains to a few ulp of the larger of Hooke's two
/// terms, at any scale: no power of a length is formed.
[[nodiscard]] double half_plane_kernel(Quantity quantity, Traction component,
                                       const Material& material, double depth, double y) noexcept;

/// Fourier transform of `half_plane_kernel`, integral over y of kernel(y) exp(-i k y), with a = |k|
/// x and s = sgn k:
///
///     stress_x: (1 + a) e^-a, -i s a e^-a        stress_y: (1 - a) e^-a, -i s (2 - a) e^-a
///     shear_xy: -i s a e^-a,  (1 - a) e^-a       for a normal and for a tangential load.
///
/// Kernels of even parity have a real transform, odd ones an imaginary one; both parts are
/// returned.
///
/// @param wavenumber  k [1/m], any sign
[[nodiscard]] std::complex<double> half_plane_transform(Quantity quantity, Traction component,
                                                        const Material& material, double depth,
                                                        double wavenumber) noexcept;

}  // namespace tactile_net
