/// @file
/// Surface tractions at the taxels' positions.
#pragma once

#include <span>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// Tractions [Pa] at the `count` positions of an array.
struct TractionField {
  std::vector<double> normal{};
  std::vector<double> tangential{};  ///< empty: frictionless
};

/// The sum of the contacts at the taxels' positions; no contact: zeros.
///
/// The value at a taxel is the traction at that point, except where the taxel's cell (its position
/// +- pitch / 2) holds a point of infinite traction: there it is the mean over the cell, the only
/// finite value that keeps the force. A point on the border of two cells is in both. `tangential`
/// is empty if no contact has friction.
///
/// @throw std::invalid_argument  the array or a contact is out of range
[[nodiscard]] TractionField sample(std::span<const Contact> contacts, const SensorArray& array);

}  // namespace tactile_net
