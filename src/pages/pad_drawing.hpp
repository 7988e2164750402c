/// @file
/// Private. The pad in section, to scale, as HTML: surface, taxels at their depths, base, axes; the
/// stress inside and the load on top.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::pages {

/// How the drawing places the scene: its y and x are in pixels of a picture `width` wide.
struct PadLayout {
  double width = 1000.0;
  double surface = 110.0;  ///< y of the pad's surface in the picture: above it loads are drawn
  double scale = 1.0;      ///< pixels per unit of length
  double middle = 0.0;     ///< y of the surface's middle
  double bottom = 0.0;     ///< depth that is drawn, in the scene's unit of length
  double thickness = 0.0;  ///< of the pad as it is drawn
  double height = 0.0;     ///< of the whole picture

  /// The picture's x of a place y along the surface.
  [[nodiscard]] double at(double y) const noexcept { return 0.5 * width + scale * (y - middle); }
};

/// What a picture along the surface has below it: y at its first end, in its middle and at its last
/// end, with the unit.
[[nodiscard]] std::vector<std::string> ends_of_surface(const Scene& scene);

/// Down to a layer's base, or on a half plane to twice the deepest taxel; at least a tenth of the
/// width is left for the pad, so that a long thin array is drawn deeper than it is.
[[nodiscard]] PadLayout pad_layout(const Scene& scene);

/// An <svg> with its words below it. Without loads no room is left for them.
///
/// @param inside  SVG that lies on the pad and under the taxels: the field of stress
/// @param above   SVG that stands on the surface: loads
[[nodiscard]] std::string draw_pad(const Scene& scene, std::string_view inside,
                                   std::string_view above);

/// Tractions on a pad, one value per taxel [Pa].
struct PadLoad {
  std::span<const double> normal{};
  std::span<const double> tangential{};  ///< empty: none
};

/// The stress across the surface that a load causes inside, as an <image>: blue presses, red pulls,
/// full colour at the largest |normal| of the load. Empty where nothing presses, and for more than
/// 1024 taxels, which would take seconds.
[[nodiscard]] std::string draw_stress(const Scene& scene, const PadLoad& load);

/// A load on the surface, pressure as an area and drag as arrows.
[[nodiscard]] std::string draw_load(const Scene& scene, const PadLoad& load);

/// All of it as a figure.
///
/// @param on_top  what the load is, in words; where there is none, the caption says so
/// @param data    the file beside the page that holds its numbers
[[nodiscard]] drawing::Figure pad_figure(const Scene& scene, const PadLoad& load,
                                         std::string_view on_top, std::string_view section,
                                         std::string_view data);

}  // namespace tactile_net::pages
