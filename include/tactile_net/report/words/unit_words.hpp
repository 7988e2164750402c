/// @file
/// Numbers of a scene for people: with units where the scene states [units], bare where it does
/// not.
///
///     in_unit(scene, Dimension::stress, 4810)       "4.81 kPa", or "4.81e+03"
///     axis_unit(scene, Dimension::length, 0.01)     {"mm", 1000}, or {"unit of length", 1}
#pragma once

#include <optional>
#include <string>

#include "tactile_net/numeric/unit_text.hpp"
#include "tactile_net/scene/scene.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net::report {

/// The label in an axis' brackets, and what to multiply its values by.
///
/// @param largest  the largest magnitude along the axis
/// @return         without [units] what the number is a multiple of ("unit of E"), and 1; an empty
///                 label for a number without dimension
[[nodiscard]] ScaledUnit axis_unit(const Scene& scene, Dimension dimension, double largest);
[[nodiscard]] ScaledUnit axis_unit(const std::optional<Units>& units, Dimension dimension,
                                   double largest);

/// "4.81 kPa"; without [units] as `brief`.
[[nodiscard]] std::string in_unit(const Scene& scene, Dimension dimension, double number);
[[nodiscard]] std::string in_unit(const std::optional<Units>& units, Dimension dimension,
                                  double number);

/// "4.81 ± 0.02 kPa"; without [units] as `plus_minus`.
[[nodiscard]] std::string in_unit(const Scene& scene, Dimension dimension, double value,
                                  double deviation);
[[nodiscard]] std::string in_unit(const std::optional<Units>& units, Dimension dimension,
                                  double value, double deviation);

/// Of a residual, and of noise beside it: that of the readings, none where they are divided by
/// their noise.
[[nodiscard]] Dimension residual_dimension(const Scene& scene) noexcept;
[[nodiscard]] Dimension residual_dimension(const SkinScene& scene) noexcept;

}  // namespace tactile_net::report
