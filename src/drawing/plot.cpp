#include "tactile_net/drawing/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::drawing {
namespace {

/// Text as JSON, typeset for people.
std::string json_words(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : typeset(text)) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20)
      out += std::string("\\u00") + digits[code / 16] + digits[code % 16];
    else if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out + '"';
}

std::string json_number(double value) { return std::isfinite(value) ? brief(value, 7) : "null"; }

template <typename Values, typename Write>
std::string json_list(const Values& values, const Write& write) {
  std::string out = "[";
  for (const auto& value : values) out += (out.size() > 1 ? "," : "") + write(value);
  return out + ']';
}

std::string json_axis(const std::string& label, bool logarithmic, const std::string& more = {}) {
  return "{\"label\":" + json_words(label) + (logarithmic ? ",\"log\":true" : "") + more + '}';
}

/// Answers that may be close: each is thinner than the one it covers, so that all are seen.
double width_of(const Curve& curve, bool alone) {
  constexpr std::array widths = {2.0, 4.0, 2.5, 1.5, 1.5, 1.5};
  if (curve.width > 0.0) return curve.width;
  if (curve.dashed || curve.marks) return 1.5;
  return alone ? 2.5 : widths[curve.colour % widths.size()];
}

std::string json_curve(const Curve& curve, bool alone) {
  std::string json = "{\"label\":" + json_words(curve.label) +
                     ",\"colour\":" + std::to_string(curve.colour) +
                     ",\"y\":" + json_list(curve.y, json_number);
  if (!curve.x.empty()) json += ",\"x\":" + json_list(curve.x, json_number);
  if (!curve.low.empty())
    json += ",\"low\":" + json_list(curve.low, json_number) +
            ",\"high\":" + json_list(curve.high, json_number);
  if (!curve.names.empty()) json += ",\"names\":" + json_list(curve.names, json_words);
  if (curve.quiet)
    json += ",\"quiet\":true";
  else
    json += ",\"width\":" + json_number(width_of(curve, alone));
  if (curve.dots) json += ",\"dots\":true";
  if (curve.marks) json += ",\"marks\":true";
  if (curve.dashed) json += ",\"dashed\":true";
  return json + '}';
}

std::string json_of(const Plot& plot, std::string_view name) {
  const auto sharing = std::count_if(plot.curves.begin(), plot.curves.end(), [](const Curve& c) {
    return c.x.empty() && !c.dots && !c.dashed;
  });
  std::string y;
  if (plot.from_zero) y += ",\"from_zero\":true";
  if (plot.y_end > 0.0) y += ",\"end\":" + json_number(plot.y_end);
  if (plot.y_at_least > 0.0) y += ",\"at_least\":" + json_number(plot.y_at_least);
  std::string map;
  if (plot.map)
    map = ",\"map\":{\"label\":" + json_words(plot.map->label) +
          ",\"low\":" + json_number(plot.map->low) + ",\"high\":" + json_number(plot.map->high) +
          ",\"most\":" + json_number(plot.map->most) + '}';
  return "{\"name\":" + json_words(name) + map +
         ",\"x\":" + json_axis(plot.x_label, plot.logarithmic_x) +
         ",\"y\":" + json_axis(plot.y_label, plot.logarithmic_y, y) +
         ",\"linear_within\":" + json_number(plot.linear_within) +
         ",\"band_label\":" + json_words(plot.band_label) +
         ",\"quiet_label\":" + json_words(plot.quiet_label) +
         ",\"height\":" + (plot.wide ? "420" : "300") +
         ",\"xs\":" + json_list(plot.x, json_number) + ",\"curves\":" +
         json_list(plot.curves,
                   [&](const Curve& curve) { return json_curve(curve, sharing < 2); }) +
         '}';
}

}  // namespace

std::string chart_html(const Plot& plot, std::string_view name) {
  return (plot.title.empty() ? "" : element("p", plot.title, "map-title")) +
         "<div class=\"chart\">" + data_html(json_of(plot, name)) + "</div>";
}

}  // namespace tactile_net::drawing
