/// @file
/// How wide a rod's contact is: Hertz on a half plane, and its counterpart on a layer.
#pragma once

#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

/// The force that a rigid frictionless rod needs for a contact of a given half width:
///
///     P = pi a^2 E b(a/h, nu) / (4 R (1 - nu^2))
///
/// with b = 1 on a half plane (Johnson 1985, 4.43). On a layer the pressure is
/// sqrt(1 - t^2) sum_m b_m U_2m(t), 8 terms, whose slope under the rod is solved for at Chebyshev
/// points with the layer's surface compliance
///
///     bonded        ((3 - 4 nu) sinh 2H - 2H) / ((3 - 4 nu) cosh 2H + 2H^2 + 5 - 12 nu + 8 nu^2)
///     frictionless  (cosh 2H - 1) / (sinh 2H + 2H)
///
/// over that of the half plane, H = k h; b is b_0. Good to 1e-8 up to a = 2 h.
struct ContactForce {
  double log_force = 0.0;          ///< log of P [N/m], for a ball of F [N]
  double by_log_half_width = 2.0;  ///< derivative of `log_force`
  double by_log_thickness = 0.0;   ///< derivative of `log_force`
  double by_poisson_ratio = 0.0;   ///< derivative of `log_force`
};

/// The force that a rod needs for a contact of a given half width.
///
/// @param half_width  a [m], > 0; on a layer at most 3 h, beyond which it is taken as 3 h in b
/// @param radius      R [m], > 0
[[nodiscard]] ContactForce rod_force(const Material& material, double half_width, double radius);

/// The half width [m] at which `rod_force` is `force` [N/m], > 0.
[[nodiscard]] double rod_half_width(const Material& material, double force, double radius);

}  // namespace tactile_net
