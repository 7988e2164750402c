/// @file
/// Private. What is told of each contact, in words and in pictures.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "report/load_dimension.hpp"
#include "tactile_net/inverse/contact_patch.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {

struct ContactColumn {
  const char* label;
  Dimension dimension;
  std::function<std::optional<Uncertain>(const ContactPatch&)> of;
  bool squared = false;  ///< an area, in the square of the dimension

  /// That suits numbers up to `largest`; without [units] it has no label.
  [[nodiscard]] ScaledUnit unit(const std::optional<Units>& units, double largest) const {
    if (!squared) return axis_unit(units, dimension, largest);
    if (!units) return {"", 1.0};
    const ScaledUnit side = axis_unit(units, dimension, std::sqrt(largest));
    return {side.label + "²", side.factor * side.factor};
  }
};

/// Of lines forces are per metre, a drag has a sign, and there is no place across.
/// @param stated  what the forces are, where it is not what the sensor's are
[[nodiscard]] inline std::vector<ContactColumn> contact_columns(
    bool of_skin, std::optional<Dimension> stated = std::nullopt) {
  const Dimension force = stated.value_or(load_dimension(of_skin));
  using Patch = const ContactPatch&;
  return {{"force", force, [](Patch one) { return std::optional(one.wrench.normal); }},
          {"drag", force,
           [of_skin](Patch one) {
             const auto& along = one.wrench.tangential_y;
             return along && of_skin ? std::optional(drag_of(one.wrench)) : along;
           }},
          {of_skin ? "centre, y" : "centre", Dimension::length,
           [](Patch one) { return one.wrench.centre_y; }},
          {"centre, z", Dimension::length, [](Patch one) { return one.wrench.centre_z; }},
          {"torsion", Dimension::moment, [](Patch one) { return one.wrench.torsion; }},
          {"drag / force", Dimension::none, [](Patch one) { return one.friction; }},
          {"margin to slipping", Dimension::none, [](Patch one) { return one.slip_margin; }},
          {of_skin ? "area" : "length", Dimension::length, [](Patch one) { return one.extent; },
           of_skin}};
}

}  // namespace tactile_net::report
