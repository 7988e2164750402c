/// @file
/// The half space under a traction along one axis: one table for every stress and displacement,
/// for point loads, rectangles and sources at imaginary depth. Private.
///
/// With phi = ln(R + x), chi = x phi - R (both harmonic) and m = 1 - 2 nu, a unit force along c
/// causes the stresses ab and the displacements a
///
///     2 pi s_ab    = 3 a b c / R^5 + m T_ab
///     2 pi 2 G u_a = delta_ac / R + a c / R^3 + m V_a
///     T_yy = psi_zz,  T_zz = psi_yy,  T_yz = -psi_yz
///
/// with psi = -phi for c = x and psi = -chi_c for y and z, so that an incompressible half space is
/// compressed along the rays from the load alone (Michell 1900), and what is left is a plane state
/// of stress with the Airy function psi. V is (phi_x, -phi_y, -phi_z) for c = x and (phi_c,
/// -chi_cy, -chi_cz) for y and z. This is Boussinesq's and Cerruti's solution (Johnson 1985, 3.2
/// and 3.6) with its terms in this order: nothing is divided by m, and nothing cancels.
#pragma once

#include <numbers>

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// @tparam Source  point_source.hpp or rectangle_source.hpp: the functions of place in the table
template <class Number, class Source>
struct HalfSpaceField {
  const Source& source;
  Axis load;
  double m;

  [[nodiscard, gnu::always_inline]] Number stress(Axis a, Axis b) const noexcept {
    const Number radial = source.radial(a, b, load);
    if (a == Axis::x || b == Axis::x) return radial * scale;
    const Axis c = across(a);
    const Axis d = across(b);
    const Number psi = load == Axis::x ? source.phi(c, d) : source.chi(c, d, load);
    return (radial + (a == b ? -m : m) * psi) * scale;
  }

  [[nodiscard, gnu::always_inline]] Number displacement(Axis a) const noexcept {
    const Number slide = load == Axis::x ? (a == Axis::x ? source.phi(a) : -source.phi(a))
                         : a == Axis::x  ? source.phi(load)
                                         : -source.chi(a, load);
    return (source.near(a, load) + m * slide) * scale;
  }

  static constexpr double scale = 0.5 / std::numbers::pi;
};

}  // namespace tactile_net
