/// @file
/// Private. The figures of a skin's pages.
#pragma once

#include <string>
#include <vector>

#include "pages/skin_map.hpp"
#include "tactile_net/lab/skin_run.hpp"

namespace tactile_net::pages {

/// A skin's scene in words: sensor, material, contacts.
[[nodiscard]] std::string scene_html(const SkinScene& scene);

/// Drags that are smaller beside the pressure are not drawn: noise has some everywhere.
inline constexpr double least_drag = 0.1;

/// What a map of tractions is drawn with: one scale for found and true, so that they compare.
struct Scales {
  double pressure = 0.0;
  double drag = 0.0;
  bool negative = false;
};

/// Widens the scales so that these tractions fit.
void take(Scales& scales, const std::vector<double>& values, const SurfaceGrid& grid);

[[nodiscard]] std::string traction_map(const SkinScene& scene, const SurfaceGrid& cells,
                                       const std::vector<double>& values, const Scales& scales);

/// The bar below such maps: colours and the longest arrow.
[[nodiscard]] std::string traction_bar(const SkinScene& scene, const Scales& scales);

/// Side by side where the window is wide.
[[nodiscard]] std::string maps(const std::vector<std::string>& pictures);

/// Of one frame that has an answer: the pad in section, and the numbers.
[[nodiscard]] std::string frame_html(const lab::SkinExperiment& experiment);

}  // namespace tactile_net::pages
