/// @file
/// The forward model without discretisation: a test that uses it commits no inverse crime.
///
///     g(y) = integral of k(y - s) f(s) ds
#pragma once

#include <span>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// How the integrals are taken.
struct Quadrature {
  int points = 31;             ///< of Gauss and Kronrod in a panel: 15, 21, 31, 41, 51 or 61
  int halvings = 16;           ///< of a panel, as long as its estimated error asks for it; >= 0
  double error_limit = 1e-10;  ///< of a contact's peak; infinite: any error is accepted
};

/// The readings of every channel, channels x count; of each contact, to 1e-10 of its peak in that
/// channel.
///
/// The substitutions s = center + (a + e) sin t (cylinder, punch) and s = center +- a / cosh v
/// (wedge) leave smooth integrands, singular edges and apex included; sampled tractions go segment
/// by segment. Panels grow by powers of 4 with the distance from the taxel, so that depths down to
/// 1e-3 half widths keep the promise; below that, readings that vanish with the depth, the small
/// difference of large parts, are refused first. Cost per taxel and channel: some hundred kernel
/// evaluations for a cylinder or punch, some thousand for a wedge, 31 to some hundred for each
/// segment of sampled tractions that is not zero.
///
/// @throw std::invalid_argument  the array, the material, a contact or the rule is out of range
/// @throw std::runtime_error     the error estimate of a contact exceeds the limit
[[nodiscard]] std::vector<double> exact_readings(const SensorArray& array, const Material& material,
                                                 std::span<const Contact> contacts,
                                                 const Quadrature& rule = {});

}  // namespace tactile_net
