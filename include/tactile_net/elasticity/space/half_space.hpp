/// @file
/// Stress, strain and displacement inside an elastic half space under a point load and under a
/// uniform traction on a rectangle.
///
/// Frame and signs as in elasticity/quantity.hpp. With R^2 = x^2 + y^2 + z^2 and m = 1 - 2 nu, a
/// unit force along c causes
///
///     2 pi stress_ab        = 3 a b c / R^5 + m T_ab
///     4 pi G displacement_a = delta_ac / R + a c / R^3 + m V_a
///
/// where T and V come from the harmonic functions ln(R + x) and x ln(R + x) - R (Boussinesq 1885,
/// Cerruti 1882; Johnson 1985, 3.2 and 3.6): docs/internals/space.md has the table. The strains
/// follow by Hooke's law. Nothing is divided by m: an incompressible skin is one like any other,
/// and so is a place on the axis of the load.
///
/// Preconditions: a material in its range (its layer is ignored), depth > 0, finite places; checked
/// by whoever builds a matrix of these, not in each call. Pure functions: thread-safe, no
/// allocation.
#pragma once

#include <span>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// The reading at (y, z) [m] from a unit point force [Pa / N for stress, 1 / N for strain, m / N].
/// Correct to a few ulp, with m T beside its other term a few ulp of the larger, a strain of the
/// largest stress in it; of even or odd parity to the bit; lengths of any size.
///
/// @param depth  x [m], > 0
[[nodiscard]] double half_space_kernel(Quantity quantity, Traction component,
                                       const Material& material, double depth, double y,
                                       double z) noexcept;

/// Readings from a unit point force at many places; `y`, `z` and `readings` have one number each.
void half_space_kernel(Quantity quantity, Traction component, const Material& material,
                       double depth, std::span<const double> y, std::span<const double> z,
                       std::span<double> readings) noexcept;

/// A rectangle of the surface, centred at the origin.
struct Rectangle {
  double width_y = 1.0;  ///< [m], > 0
  double width_z = 1.0;  ///< [m], > 0
};

/// The reading at (y, z) [m] from the middle of a rectangle that carries a uniform traction of
/// 1 Pa [Pa / Pa for stress, 1 / Pa for strain, m / Pa for displacement].
///
/// Near the rectangle in closed form (Love 1929 for the normal load), from two half diagonals on
/// by Gauss and Legendre's rule, whose error is below rounding: within 5e-14 of the largest stress
/// or displacement at that place for rectangles up to ten times as long as they are wide, and of
/// the traction for any. Of even or odd parity to the bit. Widths, distances and depth may be of
/// any size, up to 1e100 of each other.
///
/// @param depth  x [m], > 0
[[nodiscard]] double half_space_kernel(Quantity quantity, Traction component,
                                       const Material& material, const Rectangle& load,
                                       double depth, double y, double z) noexcept;

/// Readings from a rectangle under 1 Pa at many places; `y`, `z` and `readings` have one number
/// each.
void half_space_kernel(Quantity quantity, Traction component, const Material& material,
                       const Rectangle& load, double depth, std::span<const double> y,
                       std::span<const double> z, std::span<double> readings) noexcept;

}  // namespace tactile_net
