/// @file
/// What a scene's numbers `siemens` and `volts` under [network] mean.
#pragma once

#include <optional>
#include <span>

#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net {

/// From a scene's number to the library's, which is per unit of P and of a traction in SI, and
/// back.
struct ScaleUnits {
  Unit siemens{};  ///< of `Scale::siemens`
  Unit volts{};    ///< of `Scale::volts`
};

/// The unit of alpha and of the matrix P: that of weighted readings over tractions, squared.
///
/// @param noise  whose rms weights the readings, where it is given for each quantity
/// @param reads  of the sensor
[[nodiscard]] Unit alpha_unit(const Units& units, const std::optional<NoiseModel>& noise,
                              std::span<const Quantity> reads) noexcept;

/// @param alpha  the unit of alpha and of the matrix P
[[nodiscard]] ScaleUnits scale_units(const Units& units, const Unit& alpha) noexcept;

/// As a scene writes them; without [units] they are the library's numbers.
[[nodiscard]] ScaleUnits scale_units(const SceneKind auto& scene) {
  const Units units = scene.units.value_or(Units{});
  return scale_units(units, alpha_unit(units, scene.noise, scene.sensor.reads));
}

}  // namespace tactile_net
