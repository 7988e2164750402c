/// @file
/// Private. A pad in section, to scale, as HTML: surface, taxels at their depths, base, axes. What
/// loads it, and the stress inside, web/pad.js draws of the data beside it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::pages {

/// What a picture along the surface has below it: y at its first end, in its middle and at its last
/// end, with the unit.
[[nodiscard]] std::vector<std::string> ends_of_surface(const Scene& scene);

/// An <svg> with its words below it. Down to a layer's base, or on a half plane to twice the
/// deepest taxel; a long thin array is drawn deeper than it is.
/// @param loaded  there is room for a load, and places for what the script draws
[[nodiscard]] std::string draw_pad(const Scene& scene, bool loaded);

/// Tractions on a pad, one value per taxel [Pa].
struct PadLoad {
  std::span<const double> normal{};
  std::span<const double> tangential{};  ///< empty: none
};

/// The pad with a load and the stress across the surface that it causes inside: blue presses, red
/// pulls, full colour at the largest |normal| of the load. No stress for more than 1024 taxels,
/// which would take seconds.
///
/// @param on_top  what the load is, in words; where there is none, the caption says so
/// @param data    the file beside the page that holds its numbers
[[nodiscard]] drawing::Figure pad_figure(const Scene& scene, const PadLoad& load,
                                         std::string_view on_top, std::string_view section,
                                         std::string_view data);

/// A skin's pad, cut along y through the peak, with the true load, or the one that was found, and
/// the stress inside. The taxels of all rows are drawn in one plane.
/// @pre  there is an answer
[[nodiscard]] std::string pad_picture(const lab::Experiment& experiment);

}  // namespace tactile_net::pages
