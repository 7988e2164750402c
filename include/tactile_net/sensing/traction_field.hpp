/// @file
/// Tractions at points of the surface.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

/// Tractions [Pa] at the `count` places of a surface, or of an array.
struct TractionField {
  std::vector<double> normal{};
  std::vector<double> tangential{};  ///< empty: frictionless
};

/// The sum of the contacts at the surface's places; no contact: zeros.
///
/// The value at a place is the traction at that point, except where its cell (the place
/// +- spacing / 2) holds a point of infinite traction: there it is the mean over the cell, the only
/// finite value that keeps the force. A point on the border of two cells is in both. `tangential`
/// is empty if no contact has friction.
///
/// @throw std::invalid_argument  a contact is out of range
[[nodiscard]] TractionField sample(std::span<const Contact> contacts, const Surface& surface);

/// The sum of the contacts at the taxels of an array; no contact: zeros.
/// @throw std::invalid_argument  a contact or the array is out of range
[[nodiscard]] TractionField sample(std::span<const Contact> contacts, const SensorArray& array);

}  // namespace tactile_net
