/// @file
/// From stresses and displacements to any quantity a sensor reads: Hooke's law in space. Private.
#pragma once

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// The reading of a field that has stress(Axis, Axis) and displacement(Axis), the latter times 2 G;
/// no more of them is asked for than the quantity needs. Inline, so that a quantity known in
/// advance leaves no question to a loop.
///
/// @param moduli  of a `Material`, or whatever else names them alike
template <class Field, class Moduli>
[[gnu::always_inline]] inline auto read(Quantity quantity, const Field& field,
                                        const Moduli& moduli) noexcept {
  const auto& [value, name, unit, kind, a, b] = traits(quantity);
  const auto& e = moduli.youngs_modulus;
  const auto& nu = moduli.poisson_ratio;
  if (kind == QuantityKind::stress) return field.stress(a, b);
  if (kind == QuantityKind::displacement) return field.displacement(a) * ((1.0 + nu) / e);
  if (a != b) return field.stress(a, b) * (2.0 * (1.0 + nu) / e);
  const Axis c = a == Axis::x ? Axis::y : Axis::x;
  const Axis d = a == Axis::z ? Axis::y : Axis::z;
  return (field.stress(a, a) - nu * (field.stress(c, c) + field.stress(d, d))) * (1.0 / e);
}

}  // namespace tactile_net
