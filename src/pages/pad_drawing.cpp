#include "tactile_net/pages/pad_drawing.hpp"

#include <algorithm>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/lab/interior.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::pages {
namespace {

std::string px(double value) { return fixed(value, 1); }

std::string label(double x, double y, std::string_view words, std::string_view anchor = "start") {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + std::string(anchor) +
         "\">" + drawing::escaped(words) + "</text>\n";
}

}  // namespace

PadFrame pad_frame(const Scene& scene) {
  const SensorArray& sensor = scene.sensor;
  PadFrame frame;
  const double length = sensor.pitch * static_cast<double>(sensor.count);
  frame.scale = frame.width / length;
  frame.bottom = lab::interior_depth(scene);
  frame.thickness = std::clamp(frame.scale * frame.bottom, 90.0, 420.0);
  frame.height = frame.surface + frame.thickness + 34.0;
  return frame;
}

std::string draw_pad(const Scene& scene, std::string_view inside, std::string_view above) {
  const PadFrame frame = pad_frame(scene);
  const double bottom = frame.surface + frame.thickness;
  const auto depth = [&](double x) { return frame.surface + frame.thickness * x / frame.bottom; };
  std::string svg = "<svg viewBox=\"-24 0 1058 " + px(frame.height) +
                    "\" role=\"img\" aria-label=\"Section of the pad: taxels below the surface, "
                    "tractions on top\">\n";
  svg += "<rect class=\"pad\" x=\"0\" y=\"" + px(frame.surface) + "\" width=\"1000\" height=\"" +
         px(frame.thickness) + "\"/>\n";
  svg += inside;
  const double radius = std::clamp(300.0 / static_cast<double>(scene.sensor.count), 1.2, 4.0);
  for (const double x : scene.sensor.depths)
    for (std::size_t i = 0; i < scene.sensor.count; ++i)
      svg += "<circle class=\"taxel\" cx=\"" + px(frame.at(position(scene.sensor, i))) +
             "\" cy=\"" + px(depth(x)) + "\" r=\"" + px(radius) + "\"/>";
  svg += "\n<line class=\"surface\" x1=\"0\" x2=\"1000\" y1=\"" + px(frame.surface) + "\" y2=\"" +
         px(frame.surface) + "\"/>\n";
  if (scene.material.layer)
    svg += "<line class=\"base\" x1=\"0\" x2=\"1000\" y1=\"" + px(bottom) + "\" y2=\"" +
           px(bottom) + "\"/>\n" +
           label(2.0, bottom + 24.0,
                 scene.material.layer->base == Base::bonded ? "bonded to a rigid base"
                                                            : "slides on a rigid base");
  else
    svg += label(2.0, bottom + 24.0, "deep: a half plane");
  std::string at;
  for (const double x : scene.sensor.depths) at += (at.empty() ? "" : ", ") + brief(x);
  svg += label(1000.0, bottom + 24.0, "taxels at depth " + at, "end");
  const double y = frame.surface;
  svg += "<g class=\"axis\"><path d=\"M-12 " + px(y) + "v46m-5 -9l5 9l5 -9\"/></g>\n" +
         label(-16.0, y + 66.0, "x");
  svg += "<g class=\"axis\"><path d=\"M968 " + px(y - 8.0) + "h40m-9 -5l9 5l-9 5\"/></g>\n" +
         label(1014.0, y - 3.0, "y");
  svg += above;
  return svg + "</svg>\n";
}

std::string_view pad_style() noexcept {
  return R"(
.pad { fill: var(--pad); } .taxel { fill: var(--ink); } .surface { stroke: var(--ink); stroke-width: 1.5; }
.base { stroke: var(--ink); stroke-width: 4; } .axis path { stroke: var(--quiet); fill: none; stroke-width: 1.5; }
:root { --pad: #f3e3d3; }
@media screen and (prefers-color-scheme: dark) { :root { --pad: #3a322a; } }
)";
}

}  // namespace tactile_net::pages
