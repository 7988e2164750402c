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

/// The readings of every channel, channels x count, to 1e-10 of each channel's peak.
///
/// The substitution s = center + (a + e) sin t turns the cylinder and the punch into smooth
/// integrands, singular edges included; a tanh-sinh rule takes the logarithm at the wedge's apex.
/// Cost: some hundred kernel evaluations per taxel, channel and contact.
///
/// @throw std::invalid_argument  the array, the material or a contact is out of range
/// @throw std::runtime_error     a quadrature did not reach its tolerance
[[nodiscard]] std::vector<double> exact_readings(const SensorArray& array, const Material& material,
                                                 std::span<const Contact> contacts);

}  // namespace tactile_net
