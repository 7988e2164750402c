/// @file
/// How wide a ball's contact is: Hertz on a half space, and its counterpart on a layer.
#pragma once

#include "tactile_net/calibration/rod_contact.hpp"
#include "tactile_net/elasticity/material.hpp"

namespace tactile_net {

/// The force F [N] that a rigid frictionless ball needs for a contact of a given radius:
///
///     F = 4 E a^3 b(a/h, nu) / (3 R (1 - nu^2))
///
/// with b = 1 on a half space (Johnson 1985, 4.22). On a layer the pressure is an Abel integral of
/// a function phi on [0, 1], which solves (Sneddon's way; Lebedev and Ufliand 1958)
///
///     phi(t) + 2/pi a/h integral_0^1 M(s, t) phi(s) ds = d - t^2,    phi(1) = 0
///     M(s, t) = integral_0^inf (L(H) - 1) cos(H a t/h) cos(H a s/h) dH
///     b = 3/2 integral_0^1 phi
///
/// with the compliance L of rod_contact.hpp. Good to 1e-8 up to a = 2 h.
///
/// @param contact_radius  a [m], > 0; on a layer at most 3 h, beyond which it is taken as 3 h in b
/// @param radius          R [m], > 0
[[nodiscard]] ContactForce ball_force(const Material& material, double contact_radius,
                                      double radius);

/// The contact's radius [m] at which `ball_force` is `force` [N], > 0.
[[nodiscard]] double ball_contact_radius(const Material& material, double force, double radius);

}  // namespace tactile_net
