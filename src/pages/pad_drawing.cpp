#include "pages/pad_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "pages/pixel_text.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/drawing/png.hpp"
#include "tactile_net/lab/interior.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;

std::string letter(double x, double y, std::string_view words) {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\">" + std::string(words) + "</text>\n";
}

std::string line(std::string_view type, double y) {
  return "<line class=\"" + std::string(type) + "\" x1=\"0\" x2=\"1000\" y1=\"" + px(y) +
         "\" y2=\"" + px(y) + "\"/>\n";
}

double largest(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// What lies below the pad, and where the taxels are; above that the ends of y.
std::string words_below(const Scene& scene) {
  const auto length = [&](double value) {
    return report::in_unit(scene, Dimension::length, value);
  };
  const auto& layer = scene.material.layer;
  std::string ends;
  for (const std::string& end : ends_of_surface(scene)) ends += element("span", end);
  return "<div class=\"pad-words\">" + ends + "</div><div class=\"pad-words\">" +
         element("span", !layer ? "deep: a half plane"
                                : length(layer->thickness) + " thick, " +
                                      (layer->base == Base::bonded ? "bonded to a rigid base"
                                                                   : "slides on a rigid base")) +
         element("span", "taxels at depth x = " + report::depths_in_words(scene)) + "</div>\n";
}

}  // namespace

std::vector<std::string> ends_of_surface(const Scene& scene) {
  const Surface places = surface(scene);
  const auto from_middle = [&](double y) {
    return report::in_unit(scene, Dimension::length, places.centre + y);
  };
  return {"y = " + from_middle(-places.half_width()), places.centre == 0.0 ? "0" : from_middle(0.0),
          from_middle(places.half_width())};
}

PadLayout pad_layout(const Scene& scene) {
  PadLayout layout;
  const Surface places = surface(scene);
  layout.middle = places.centre;
  layout.scale = layout.width / (2.0 * places.half_width());
  layout.bottom = lab::interior_depth(scene);
  layout.thickness = std::clamp(layout.scale * layout.bottom, 90.0, 420.0);
  layout.height = layout.surface + layout.thickness + 4.0;
  return layout;
}

std::string draw_pad(const Scene& scene, std::string_view inside, std::string_view above) {
  const PadLayout layout = pad_layout(scene);
  const double top = above.empty() ? layout.surface - 40.0 : 0.0;
  const auto depth = [&](double x) {
    return layout.surface + layout.thickness * x / layout.bottom;
  };
  std::string svg = "<svg class=\"section\" viewBox=\"-34 " + px(top) + " 1078 " +
                    px(layout.height - top) +
                    "\" role=\"img\" aria-label=\"Section of the pad: taxels below the surface" +
                    (above.empty() ? "" : ", tractions on top") + "\">\n";
  svg += "<rect class=\"pad\" x=\"0\" y=\"" + px(layout.surface) + "\" width=\"1000\" height=\"" +
         px(layout.thickness) + "\"/>\n";
  svg += inside;
  const double radius = std::clamp(300.0 / static_cast<double>(scene.sensor.count), 1.2, 4.0);
  std::set<std::pair<double, double>> drawn;  // several quantities may be read at one place
  for (const Site& site : sites(scene.sensor))
    if (drawn.emplace(site.y, site.depth).second) {
      const double half = std::max(0.5 * site.width * layout.scale, radius);
      svg += "<rect class=\"taxel\" x=\"" + px(layout.at(site.y) - half) + "\" y=\"" +
             px(depth(site.depth) - radius) + "\" width=\"" + px(2.0 * half) + "\" height=\"" +
             px(2.0 * radius) + "\" rx=\"" + px(radius) + "\"/>";
    }
  const double y = layout.surface;
  svg += '\n' + line("surface", y);
  if (scene.material.layer) svg += line("base", y + layout.thickness);
  svg += "<g class=\"axis\"><path d=\"M-12 " + px(y) + "v46m-5 -9l5 9l5 -9\"/><path d=\"M968 " +
         px(y - 8.0) + "h40m-9 -5l9 5l-9 5\"/></g>\n" + letter(-20.0, y + 76.0, "x") +
         letter(1016.0, y - 1.0, "y");
  svg += above;
  return svg + "</svg>\n" + words_below(scene);
}

std::string draw_stress(const Scene& scene, const PadLoad& load) {
  constexpr std::size_t rows = 18;
  const double most = largest(load.normal);
  const std::size_t count = load.normal.size();
  if (!(most > 0.0) || count > 1024) return {};
  const lab::InteriorKernels kernels = lab::interior_kernels(scene, rows, !load.tangential.empty());
  std::vector<std::uint8_t> pixels;
  for (const double stress : lab::interior_stress(kernels, load.normal, load.tangential))
    pixels.push_back(drawing::diverging_index(stress / most));
  const PadLayout layout = pad_layout(scene);
  return "<image x=\"0\" y=\"" + px(layout.surface) + "\" width=\"1000\" height=\"" +
         px(layout.thickness) + "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," +
         drawing::base64(
             drawing::png(count, rows, pixels, drawing::diverging({192, 57, 43}, {33, 102, 172}))) +
         "\"/>\n";
}

std::string draw_load(const Scene& scene, const PadLoad& load) {
  const PadLayout layout = pad_layout(scene);
  const double most = largest(load.normal);
  if (!(most > 0.0)) return {};
  const Surface places = surface(scene);
  const auto x = [&](std::size_t i) { return layout.at(places.position(i)); };
  std::string area = "M0 " + px(layout.surface);
  for (std::size_t i = 0; i < load.normal.size(); ++i)
    area += 'L' + px(x(i)) + ' ' + px(layout.surface - 85.0 * load.normal[i] / most);
  std::string arrows;
  const double drag = largest(load.tangential);
  const std::size_t every = (load.tangential.size() + 40) / 41;
  for (std::size_t i = 0; i < load.tangential.size() && drag > 0.0; i += every) {
    const double length = 36.0 * load.tangential[i] / drag;
    const double head = std::copysign(std::min(6.0, std::abs(length)), length);
    if (std::abs(length) < 1.5) continue;
    arrows += 'M' + px(x(i)) + ' ' + px(layout.surface - 5.0) + 'h' + px(length) + 'm' + px(-head) +
              " -4l" + px(head) + " 4l" + px(-head) + " 4";
  }
  return "<path class=\"pressure\" d=\"" + area + "L1000 " + px(layout.surface) + "Z\"/>" +
         (arrows.empty() ? "" : "<path class=\"drag\" d=\"" + arrows + "\"/>") + '\n';
}

drawing::Figure pad_figure(const Scene& scene, const PadLoad& load, std::string_view on_top,
                           std::string_view section, std::string_view data) {
  const std::string loads = draw_load(scene, load);
  return {.name = "pad",
          .section = std::string(section),
          .caption = loads.empty()
                         ? "The pad in section, to scale: the taxels lie at their depth, and "
                           "nothing presses."
                         : "The pad in section, to scale. On top " + std::string(on_top) +
                               "; inside, the stress across the surface that they cause, which is "
                               "what smooths: blue presses, red pulls.",
          .plot = {},
          .picture = draw_pad(scene, draw_stress(scene, load), loads),
          .data = std::string(data)};
}

}  // namespace tactile_net::pages
