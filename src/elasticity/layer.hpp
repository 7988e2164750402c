/// @file
/// Private. Stress and strain in an elastic layer on a rigid base, per wavenumber.
///
/// Frame and signs as in half_plane.hpp; the layer fills 0 <= depth <= h. With H = |k| h,
/// a = |k| depth, U = 2 H - a, kappa = 3 - 4 nu, m = 1 - 2 nu, n = 2 - 2 nu and s = sgn k, a normal
/// and a tangential load of unit amplitude cause, on a bonded base, over Delta = kappa cosh^2 H +
/// H^2 + m^2 (t = H - a):
///
///     stress_x   kappa (cosh U + a sinh U) / 2 + (H t + (n^2 + m^2) / 2) cosh a + (H + t)/2 sinh a
///                -i s [(H t + n m) sinh a + a (kappa cosh U + cosh a) / 2]
///     stress_y   kappa (cosh U - a sinh U) / 2 + (1/2 - m n - H t) cosh a + (3 H - t)/2 sinh a
///                -i s [kappa (sinh U - a/2 cosh U) + (3 H + t)/2 cosh a - (H t + n m + 1) sinh a]
///     shear_xy   -i s [a (kappa cosh U + cosh a) / 2 - (H t + n m) sinh a]
///                kappa (cosh U - a sinh U) / 2 + (H t + (n^2 + m^2) / 2) cosh a - (H + t)/2 sinh a
///
/// and on a frictionless base, over D = sinh(2 H) / 2 + H:
///
///     stress_x   (sinh U + sinh a + a cosh U + (H + t) cosh a) / 2
///                -i s (a sinh U + (H + t) sinh a) / 2
///     stress_y   (sinh U + sinh a - a cosh U - (H + t) cosh a) / 2
///                -i s (2 cosh U + 2 cosh a - a sinh U - (H + t) sinh a) / 2
///     shear_xy   -i s (a sinh U - (H + t) sinh a) / 2
///                (sinh U - sinh a - a cosh U + (H + t) cosh a) / 2
///
/// These are the products of hyperbolic functions of a displacement ansatz multiplied out, which
/// removes the difference of terms of size H^2 that the ansatz leaves: what remains tends to the
/// half plane term by term.
#pragma once

#include <complex>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// The integral over y of the layer's kernel times exp(-i k y). Correct to some ulp of the half
/// plane's largest transform at that depth for every k: no exponential grows. Regular at nu = 0.5.
///
/// At k = 0 it is the limit, with one exception: stress_y (and the strains) under a tangential load
/// on a frictionless base has a pole -i / (k h), because nothing but the far pad holds that load;
/// its value at k = 0 is 0, the principal value.
///
/// Preconditions: material.layer is present, 0 < depth <= thickness, and quantity and component are
/// a line's, as in half_plane.hpp. Pure, no allocation.
///
/// @param wavenumber  k [1/m], any sign
[[nodiscard]] std::complex<double> layer_transform(Quantity quantity, Traction component,
                                                   const Material& material, double depth,
                                                   double wavenumber) noexcept;

}  // namespace tactile_net
