#include "tactile_net/scene/scale_units.hpp"

#include "scene/sections.hpp"
#include "scene/skin_sections.hpp"

namespace tactile_net {

Unit alpha_unit(const Units& units, const SkinScene& scene) {
  const bool weighted = scene.noise && scene.noise->weights_rows;
  const QuantityKind kind =
      scene.sensor.reads.empty() ? QuantityKind::stress : traits(scene.sensor.reads.front()).kind;
  if (!weighted && kind == QuantityKind::stress) return {};
  const Unit& stress = units.stress;
  Unit one = inverse(stress);
  if (!weighted && kind == QuantityKind::displacement)
    one = {"", one.multiplier * units.length.multiplier, one.divisor * units.length.divisor};
  return {"", one.multiplier * one.multiplier, one.divisor * one.divisor};
}

ScaleUnits scale_units(const Units& units, const Unit& alpha) noexcept {
  return {.siemens = inverse(alpha), .volts = inverse(units.stress)};
}

ScaleUnits scale_units(const Scene& scene) {
  const Units units = scene.units.value_or(Units{});
  return scale_units(units, alpha_unit(units, scene));
}

ScaleUnits scale_units(const SkinScene& scene) {
  const Units units = scene.units.value_or(Units{});
  return scale_units(units, alpha_unit(units, scene));
}

}  // namespace tactile_net
