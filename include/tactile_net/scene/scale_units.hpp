/// @file
/// What a scene's numbers `siemens` and `volts` under [network] mean.
#pragma once

#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net {

/// From a scene's number to the library's, which is per unit of P and of a traction in SI, and
/// back.
struct ScaleUnits {
  Unit siemens{};  ///< of `Scale::siemens`
  Unit volts{};    ///< of `Scale::volts`
};

/// @param alpha  the unit of alpha and of the matrix P
[[nodiscard]] ScaleUnits scale_units(const Units& units, const Unit& alpha) noexcept;

/// As a scene writes them; without [units] they are the library's numbers.
[[nodiscard]] ScaleUnits scale_units(const Scene& scene);
[[nodiscard]] ScaleUnits scale_units(const SkinScene& scene);

}  // namespace tactile_net
