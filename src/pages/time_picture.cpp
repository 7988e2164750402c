#include "pages/time_picture.hpp"

#include <algorithm>
#include <cstdint>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/drawing/png.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::escaped;

std::string ticks(const Range& range, const ScaledUnit& unit) {
  if (range.empty()) return "<div></div>";
  const auto tick = [&](double value) {
    return escaped(drawing::typeset(brief(value * unit.factor)));
  };
  std::string text = "<div class=\"ticks\"><span>" + tick(range.high) +
                     (unit.label.empty() ? "" : "<br>" + escaped(unit.label)) + "</span>";
  if (range.low < 0.0 && -range.low > 0.15 * range.high && range.high > -0.15 * range.low)
    text += "<span class=\"zero\" style=\"top:" + fixed(range.at(0.0), 1) + "%\">0</span>";
  const bool from_zero = std::abs(range.low) < 0.02 * range.high;
  return text + "<span>" + tick(from_zero ? 0.0 : range.low) + "</span></div>";
}

std::string point(std::size_t column, double y) {
  return fixed(static_cast<double>(column) + 0.5, 1) + ' ' + fixed(y, 2);
}

/// Of a column between two gaps: a line of its own width, where a point would not be seen.
constexpr double lone_width = 0.6;
std::string lone_point(std::size_t column, double y) {
  return fixed(static_cast<double>(column) + 0.5 - 0.5 * lone_width, 1) + ' ' + fixed(y, 2) + 'h' +
         fixed(lone_width, 1);
}

}  // namespace

std::string stretched_picture(std::size_t columns, const Range& range, const ScaledUnit& unit,
                              std::string_view label, std::string_view type,
                              const std::string& inside, const Ends& below) {
  std::string html = "<div class=\"picture\">" + ticks(range, unit) + "<svg class=\"" +
                     std::string(type) + "\" viewBox=\"0 0 " + std::to_string(columns) +
                     " 100\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"" +
                     escaped(label) + "\">" + inside + "</svg></div><div class=\"clock\">";
  for (const std::string& end : below) html += element("span", end);
  return html + "</div>";
}

std::string path_of(std::size_t columns, const Range& range, const ColumnValue& value,
                    std::string_view type) {
  std::string d;
  bool pen = false;
  for (std::size_t i = 0; i < columns; ++i) {
    const double y = range.at(value(i));
    const bool ends = i + 1 == columns || !std::isfinite(range.at(value(i + 1)));
    if (std::isfinite(y) && !pen && ends)
      d += "M" + lone_point(i, y);
    else if (std::isfinite(y))
      d += (pen ? "L" : "M") + point(i, y);
    pen = std::isfinite(y);
  }
  return "<path class=\"" + std::string(type) + "\" d=\"" + d + "\"/>";
}

std::string area_of(std::size_t columns, const Range& range, const ColumnValue& low,
                    const ColumnValue& high, std::string_view type) {
  const auto known = [&](std::size_t i) {
    return std::isfinite(range.at(low(i))) && std::isfinite(range.at(high(i)));
  };
  std::string d;
  for (std::size_t first = 0; first < columns; ++first) {
    if (!known(first)) continue;
    std::size_t end = first;  // of a piece without a gap
    if (first + 1 == columns || !known(first + 1)) {
      const std::string low_end = fixed(range.at(low(first)), 2);
      d += "M" + lone_point(first, range.at(high(first))) + "V" + low_end + "h-" +
           fixed(lone_width, 1) + "Z";
      continue;
    }
    for (; end < columns && known(end); ++end)
      d += (end == first ? "M" : "L") + point(end, range.at(high(end)));
    for (std::size_t i = end; i-- > first;) d += "L" + point(i, range.at(low(i)));
    d += "Z";
    first = end;
  }
  return "<path class=\"" + std::string(type) + "\" d=\"" + d + "\"/>";
}

std::string level_line(std::size_t columns, const Range& range, double level,
                       std::string_view type) {
  const std::string y = fixed(range.at(level), 2);
  return "<line class=\"" + std::string(type) + "\" x1=\"0\" x2=\"" + std::to_string(columns) +
         "\" y1=\"" + y + "\" y2=\"" + y + "\"/>";
}

std::string heat_map(std::size_t columns, std::size_t taxels, Traction traction,
                     const std::function<double(std::size_t column, std::size_t taxel)>& value) {
  std::vector<std::uint8_t> pixels(taxels * columns);
  for (std::size_t column = 0; column < columns; ++column)
    for (std::size_t i = 0; i < taxels; ++i)
      pixels[(taxels - 1 - i) * columns + column] = drawing::diverging_index(value(column, i));
  const auto palette = traction == Traction::normal
                           ? drawing::diverging({192, 57, 43}, {33, 102, 172})
                           : drawing::diverging({118, 42, 131}, {200, 98, 6});
  return "<image x=\"0\" y=\"0\" width=\"" + std::to_string(columns) +
         "\" height=\"100\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," +
         drawing::base64(drawing::png(columns, taxels, pixels, palette)) + "\"/>";
}

}  // namespace tactile_net::pages
