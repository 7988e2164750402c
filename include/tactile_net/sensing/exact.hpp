/// @file
/// The forward model without discretisation: a test that uses it commits no inverse crime.
///
///     g(y) = integral of k(y - s) f(s) ds
#pragma once

#include <span>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/sensing/aperture.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// How the integrals are taken.
struct Quadrature {
  int points = 31;             ///< Gauss-Kronrod points in a panel: 15, 21, 31, 41, 51 or 61
  int halvings = 16;           ///< of a panel whose estimated error is too large, at most; >= 0
  double error_limit = 1e-10;  ///< relative to a contact's peak; infinite: any error is accepted
};

/// The readings of one channel at any places; each contact's share to 1e-10 of its peak there.
///
/// Readings that all but vanish where their parts do not, below the middle of a symmetrical contact
/// or at a layer's base, are answered too: to 1e-12 of the integral of |k f|, in a layer to 4e-13
/// besides of what the contact's force would cause at the base's depth in a half plane.
///
/// A cylinder on a half plane has its reading in closed form, from depths of a hundredth of its
/// half width on. For other indenters the substitutions s = center + (a + e) sin t (cylinder,
/// punch) and s = center +- a / cosh v (wedge) leave smooth integrands, singular edges and apex
/// included. Panels grow by powers of 4 with the distance from the taxel, so that depths down to
/// 1e-3 half widths keep the promise; below that, readings that vanish with the depth, the small
/// difference of large parts, are refused first. Sampled tractions are sums of `HatKernel`s,
/// without a quadrature. Cost per taxel: a complex root for a cylinder on a half plane, some
/// hundred kernel evaluations for another or a punch, some thousand for a wedge, one `HatKernel`
/// for each sampled value that is not zero.
///
/// @param places    middles of the taxels, y [m], in any order
/// @param aperture  of every taxel, made for the channel's depth; a point by default
/// @throw std::invalid_argument  the depth, the material, a contact or the rule is out of range
/// @throw std::runtime_error     the error estimate of a contact exceeds the limit
[[nodiscard]] std::vector<double> exact_readings(
    const Channel& channel, std::span<const double> places, const Material& material,
    std::span<const Contact> contacts, const Quadrature& rule = {}, const Aperture& aperture = {});

/// The readings of every channel of an array, channels x count.
///
/// @throw  as for one channel; std::invalid_argument if the array is out of range
[[nodiscard]] std::vector<double> exact_readings(const SensorArray& array, const Material& material,
                                                 std::span<const Contact> contacts,
                                                 const Quadrature& rule = {});

}  // namespace tactile_net
