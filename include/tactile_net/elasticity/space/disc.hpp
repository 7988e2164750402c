/// @file
/// Loads on a circle whose field inside a half space is known exactly: what a sphere, a flat punch
/// and a cone press, and what they drag.
///
/// A traction that depends on the distance r from the middle alone is a row of point sources at the
/// imaginary depths i t, |t| <= a = radius: its field is the integral over t of g(t) times the
/// point load's, with x + i t in place of x in the potentials (docs/internals/space.md), and
///
///     g(t) = 2 integral_t^a r p(r) / sqrt(r^2 - t^2) dr.
///
/// So Hertz' sphere (Huber 1904; dragged: Hamilton 1983), Boussinesq's punch and Love's cone are
/// one rule. Sums of discs make the others: a sphere that slides with the friction mu drags mu
/// times its own normal traction; one that slips partially, but for the stick radius c, drags two
/// spheres' tractions, of radius a and force mu F, of radius c and force -mu F (c / a)^3 (Cattaneo
/// 1938, Mindlin 1949).
#pragma once

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// Profile of the traction, with F = force:
///
///     sphere  3 F / (2 pi a^2) sqrt(1 - r^2 / a^2)       (Hertz; Johnson 1985, 3.58)
///     punch   F / (2 pi a sqrt(a^2 - r^2))               (Johnson 1985, 3.34)
///     cone    F / (pi a^2) arccosh(a / r)                (Johnson 1985, 5.10)
enum class DiscProfile { sphere, punch, cone };

/// A load along one axis, centred at the origin.
struct Disc {
  DiscProfile profile = DiscProfile::sphere;
  double radius = 1.0;  ///< a [m], > 0
  double force = 1.0;   ///< F [N], of any sign
};

/// @throw std::invalid_argument  the radius is not > 0, or the force not finite
void check(const Disc& disc);

/// Traction [Pa] at the distance r >= 0 [m] from the middle; infinite where the profile is
/// singular, 0 outside.
[[nodiscard]] double traction(const Disc& disc, double r) noexcept;

/// The reading of a half space at (y, z) [m] from the middle. Correct to some 4e-15 of the largest
/// stress (or displacement) of that load at that depth x, and to as much times (a / x)^2 where that
/// is more: 1e-12 at a twentieth of the radius. Some 40 to 500 times a point load's work.
///
/// Preconditions: a disc and a material in their ranges (the layer is ignored), depth > 0 [m].
[[nodiscard]] double disc_reading(Quantity quantity, Traction component, const Material& material,
                                  const Disc& disc, double depth, double y, double z) noexcept;

}  // namespace tactile_net
