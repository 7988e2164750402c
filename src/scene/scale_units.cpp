#include "tactile_net/scene/scale_units.hpp"

#include <algorithm>

namespace tactile_net {

Unit alpha_unit(const Units& units, const std::optional<NoiseModel>& noise,
                std::span<const Quantity> reads) noexcept {
  const bool weighted = noise && noise->weights_rows;
  const auto other = std::find_if(reads.begin(), reads.end(), [](Quantity quantity) {
    return traits(quantity).kind != QuantityKind::stress;
  });
  if (!weighted && other == reads.end()) return {};
  Unit one = inverse(units.stress);
  if (!weighted && traits(*other).kind == QuantityKind::displacement)
    one = {"", one.multiplier * units.length.multiplier, one.divisor * units.length.divisor};
  return {"", one.multiplier * one.multiplier, one.divisor * one.divisor};
}

ScaleUnits scale_units(const Units& units, const Unit& alpha) noexcept {
  return {.siemens = inverse(alpha), .volts = inverse(units.stress)};
}

}  // namespace tactile_net
