/// @file
/// The pad in section, to scale, as SVG text: surface, taxels at their depths, base, axes.
#pragma once

#include <string>
#include <string_view>

#include "tactile_net/scene/scene.hpp"

namespace tactile_net::pages {

/// How the drawing places the scene: its y and x are in pixels of a picture `width` wide.
struct PadFrame {
  double width = 1000.0;
  double surface = 110.0;  ///< y of the pad's surface in the picture: above it loads are drawn
  double scale = 1.0;      ///< pixels per unit of length
  double bottom = 0.0;     ///< depth that is drawn, in the scene's unit of length
  double thickness = 0.0;  ///< of the pad as it is drawn
  double height = 0.0;     ///< of the whole picture

  /// The picture's x of a place y along the surface.
  [[nodiscard]] double at(double y) const noexcept { return 0.5 * width + scale * y; }
};

/// Down to a layer's base, or on a half plane to twice the deepest taxel; at least a tenth of the
/// width is left for the pad, so that a long thin array is drawn deeper than it is.
[[nodiscard]] PadFrame pad_frame(const Scene& scene);

/// @param inside  SVG that lies on the pad and under the taxels: the field of stress
/// @param above   SVG that stands on the surface: loads
[[nodiscard]] std::string draw_pad(const Scene& scene, std::string_view inside,
                                   std::string_view above);

/// CSS for the drawing, for light and dark.
[[nodiscard]] std::string_view pad_style() noexcept;

}  // namespace tactile_net::pages
