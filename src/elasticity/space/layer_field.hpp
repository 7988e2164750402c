/// @file
/// From functions of the distance to a layer's readings. Private.
#pragma once

#include <utility>

#include "elasticity/space/layer_table.hpp"
#include "elasticity/space/read.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// Tables times their angles at a place (y, z), for a load along z in exchanged axes: tables of f /
/// r^j and the place in units of the thickness, or tables of f and the place's direction.
template <class Table, class Number = double>
struct LayerField {
  const Table& table;
  Traction load;
  Number y, z;

  [[nodiscard]] Number stress(Axis a, Axis b) const noexcept {
    using enum LayerTable;
    a = turned(a);
    b = turned(b);
    if (a > b) std::swap(a, b);
    const bool normal = load == Traction::normal;
    if (b == Axis::x) return normal ? table(normal_x) : y * table(tangential_x);
    if (a == Axis::x) {
      if (normal) return (b == Axis::y ? y : z) * table(normal_radial);
      return vector(b, tangential_mean, tangential_turning);
    }
    if (a != b)
      return normal ? 2.0 * y * z * table(normal_deviator)
                    : z * table(tangential_deviator) +
                          z * (3.0 * y * y - z * z) * table(tangential_deviator_turning);
    const Number trace = normal ? table(normal_trace) : y * table(tangential_trace);
    const Number deviator =
        normal ? (y * y - z * z) * table(normal_deviator)
               : y * table(tangential_deviator) +
                     y * (y * y - 3.0 * z * z) * table(tangential_deviator_turning);
    return a == Axis::y ? trace + deviator : trace - deviator;
  }
  [[nodiscard]] Number displacement(Axis a) const noexcept {
    using enum LayerTable;
    a = turned(a);
    const bool normal = load == Traction::normal;
    if (a == Axis::x)
      return normal ? table(normal_displacement_x) : y * table(tangential_displacement_x);
    if (normal) return (a == Axis::y ? y : z) * table(normal_displacement_radial);
    return vector(a, tangential_displacement_mean, tangential_displacement_turning);
  }

 private:
  [[nodiscard]] Axis turned(Axis a) const noexcept {
    return load == Traction::tangential_z ? exchanged(a) : a;
  }
  [[nodiscard]] Number vector(Axis a, LayerTable mean, LayerTable turning) const noexcept {
    return a == Axis::y ? table(mean) + (y * y - z * z) * table(turning)
                        : 2.0 * y * z * table(turning);
  }
};

/// The reading of a unit point force in a layer, whose thickness is the unit of tables and place.
template <class Table>
double layer_reading(Quantity quantity, Traction load, const Material& material, const Table& table,
                     double y, double z) noexcept {
  const double h = material.layer->thickness;
  if (load == Traction::tangential_z) std::swap(y, z);
  const double value = read(quantity, LayerField<Table>{table, load, y, z}, material) / h;
  return traits(quantity).kind == QuantityKind::displacement ? value : value / h;
}

}  // namespace tactile_net
