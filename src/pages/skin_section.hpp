/// @file
/// Private. Sections of a skin: tractions along a line through the peak, and the pad below it.
#pragma once

#include <string>

#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/lab/skin_run.hpp"

namespace tactile_net::pages {

/// The cell where the answer presses hardest.
struct PeakCell {
  std::size_t row = 0;
  std::size_t column = 0;
};
[[nodiscard]] PeakCell peak_of(const lab::SkinExperiment& experiment);

/// Pressure and the drag along `along`, y or z, with bands of two deviations and the truth.
[[nodiscard]] std::string section_picture(const lab::SkinExperiment& experiment, Axis along);

/// The pad to scale, cut along y through the peak: surface, taxels, base, the true load on top, the
/// stress across the surface inside.
[[nodiscard]] std::string pad_picture(const lab::SkinExperiment& experiment);

}  // namespace tactile_net::pages
