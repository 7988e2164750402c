#include "pages/skin_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "pages/pixel_text.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/drawing/png.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::Colour;
using drawing::element;
using drawing::escaped;
using drawing::typeset;

// ColorBrewer's Reds, Blues and Purples: even steps of lightness, and told apart by colour-blind
// eyes. In the dark the page's own paper is nothing, and bright is much.
constexpr Colour white{255, 255, 255};
constexpr Colour black{25, 25, 25};
constexpr std::array signed_light = {
    Colour{103, 0, 13},    Colour{203, 24, 29},   Colour{251, 106, 74},
    Colour{252, 187, 161}, Colour{254, 229, 217}, white,
    Colour{222, 235, 247}, Colour{158, 202, 225}, Colour{66, 146, 198},
    Colour{8, 81, 156},    Colour{8, 48, 107}};
constexpr std::array signed_dark = {
    Colour{254, 224, 210}, Colour{252, 146, 114}, Colour{239, 59, 44},
    Colour{153, 20, 20},   Colour{84, 10, 15},    black,
    Colour{8, 48, 90},     Colour{15, 82, 148},   Colour{48, 130, 190},
    Colour{120, 182, 220}, Colour{215, 232, 247}};
constexpr std::array sizes_light = {white, Colour{218, 218, 235}, Colour{158, 154, 200},
                                    Colour{106, 81, 163}, Colour{63, 0, 125}};
constexpr std::array sizes_dark = {black, Colour{63, 30, 110}, Colour{106, 81, 163},
                                   Colour{158, 154, 200}, Colour{226, 224, 242}};

struct Stops {
  std::span<const Colour> light;
  std::span<const Colour> dark;
};

Stops stops_of(MapColours colours) {
  if (colours == MapColours::sizes) return {sizes_light, sizes_dark};
  return {signed_light, signed_dark};
}

/// Along a map's longer side, at most: of more cells some share a pixel, and pages stay small.
constexpr std::size_t most_pixels = 160;
/// Dots of taxels, at most.
constexpr std::size_t most_dots = 2048;

/// Means over square blocks of cells.
struct Pixels {
  Pixels(const MapGrid& grid, std::span<const double> values)
      : block((std::max(grid.rows, grid.columns) + most_pixels - 1) / most_pixels),
        rows((grid.rows + block - 1) / block),
        columns((grid.columns + block - 1) / block) {
    for (std::size_t column = 0; column < columns; ++column)
      for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t last_row = std::min((row + 1) * block, grid.rows);
        const std::size_t last_column = std::min((column + 1) * block, grid.columns);
        double sum = 0.0;
        std::size_t cells = 0;
        for (std::size_t i = row * block; i < last_row; ++i)
          for (std::size_t j = column * block; j < last_column; ++j, ++cells)
            sum += values[i * grid.columns + j];
        means.push_back(sum / static_cast<double>(cells));
      }
  }

  std::size_t block, rows, columns;
  std::vector<double> means{};
};

/// What a last block has beyond the grid's end lies beyond the picture's.
std::string image(const MapGrid& grid, const Pixels& of, std::span<const std::uint8_t> pixels,
                  std::span<const Colour> stops, std::string_view type) {
  const auto share = [&](std::size_t count, std::size_t cells) {
    return static_cast<double>(count * of.block) / static_cast<double>(cells);
  };
  return "<image class=\"" + std::string(type) + "\" width=\"" +
         px(share(of.rows, grid.rows) * MapGrid::width) + "\" height=\"" +
         px(share(of.columns, grid.columns) * grid.height()) +
         "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," +
         drawing::base64(drawing::png(of.rows, of.columns, pixels, drawing::ramp(stops))) +
         "\"/>\n";
}

/// CSS of a bar that runs through the colours.
std::string gradient(std::span<const Colour> stops) {
  std::string css = "linear-gradient(to right";
  for (const Colour& stop : stops)
    css += ",rgb(" + std::to_string(stop.red) + ',' + std::to_string(stop.green) + ',' +
           std::to_string(stop.blue) + ')';
  return css + ')';
}

}  // namespace

MapGrid map_grid(const SurfaceGrid& grid) {
  return {grid.rows, grid.columns, grid.spacing_y, grid.spacing_z, grid.y(0), grid.z(0)};
}

std::string map_image(const MapGrid& grid, std::span<const double> values, double most,
                      MapColours colours) {
  const Pixels of(grid, values);
  std::vector<std::uint8_t> pixels;
  for (const double mean : of.means)
    pixels.push_back(colours == MapColours::sizes ? drawing::ramp_index(mean / most)
                                                  : drawing::diverging_index(mean / most));
  const Stops stops = stops_of(colours);
  return image(grid, of, pixels, stops.light, "in-light") +
         image(grid, of, pixels, stops.dark, "in-dark");
}

std::string map_arrows(const MapGrid& grid, std::span<const double> along_y,
                       std::span<const double> along_z, double most) {
  constexpr std::size_t most_arrows = 24;  // along the longer side
  const std::size_t block = (std::max(grid.rows, grid.columns) + most_arrows - 1) / most_arrows;
  const double reach =
      grid.scale() * std::min(grid.spacing_y, grid.spacing_z) * static_cast<double>(block) / most;
  std::string shafts;
  for (std::size_t r = 0; r < grid.rows; r += block)
    for (std::size_t c = 0; c < grid.columns; c += block) {
      double y = 0.0;
      double z = 0.0;
      const std::size_t last_r = std::min(r + block, grid.rows);
      const std::size_t last_c = std::min(c + block, grid.columns);
      for (std::size_t i = r; i < last_r; ++i)
        for (std::size_t j = c; j < last_c; ++j) {
          y += along_y[i * grid.columns + j];
          z += along_z[i * grid.columns + j];
        }
      const auto cells = static_cast<double>((last_r - r) * (last_c - c));
      const double across = reach * y / cells;
      const double down = reach * z / cells;
      const double length = std::hypot(across, down);
      if (!(length > std::max(3.0, 0.1 * reach * most))) continue;
      const double middle_r = 0.5 * static_cast<double>(r + last_r - 1);
      const double middle_c = 0.5 * static_cast<double>(c + last_c - 1);
      const double x0 = grid.across(grid.first_y + middle_r * grid.spacing_y) - 0.5 * across;
      const double y0 = grid.down(grid.first_z + middle_c * grid.spacing_z) - 0.5 * down;
      const double head = std::min(9.0, 0.45 * length) / length;
      const double back_x = head * across;
      const double back_y = head * down;
      shafts += 'M' + px(x0) + ' ' + px(y0) + 'l' + px(across) + ' ' + px(down) + 'm' +
                px(-back_x - 0.5 * back_y) + ' ' + px(-back_y + 0.5 * back_x) + 'l' +
                px(back_x + 0.5 * back_y) + ' ' + px(back_y - 0.5 * back_x) + 'l' +
                px(-back_x + 0.5 * back_y) + ' ' + px(-back_y - 0.5 * back_x);
    }
  if (shafts.empty()) return {};
  return "<path class=\"arrow-rim\" d=\"" + shafts + "\"/><path class=\"arrow\" d=\"" + shafts +
         "\"/>\n";
}

std::string map_outline(const MapGrid& grid, const std::vector<bool>& inside) {
  const double width = grid.scale() * grid.spacing_y;
  const double height = grid.scale() * grid.spacing_z;
  const auto is_inside = [&](std::size_t row, std::size_t column) {
    return row < grid.rows && column < grid.columns && inside[row * grid.columns + column];
  };
  std::string d;
  // Each edge once, between a cell and the one before it.
  for (std::size_t row = 0; row <= grid.rows; ++row)
    for (std::size_t column = 0; column <= grid.columns; ++column) {
      const std::string at = 'M' + px(static_cast<double>(row) * width) + ' ' +
                             px(static_cast<double>(column) * height);
      if (is_inside(row, column) != (row > 0 && is_inside(row - 1, column)))
        d += at + 'v' + px(height);
      if (is_inside(row, column) != (column > 0 && is_inside(row, column - 1)))
        d += at + 'h' + px(width);
    }
  return d.empty() ? d : "<path class=\"support\" d=\"" + d + "\"/>\n";
}

namespace {

double taxel_radius(const SkinArray& skin) {
  return std::clamp(90.0 / std::sqrt(static_cast<double>(taxel_count(skin))) / 4.0, 1.5, 4.0);
}

/// What `draw` makes of each place where taxels are that are dead, or where those are that are not;
/// several quantities may be read at one.
std::string at_taxels(const SkinArray& skin, std::span<const std::size_t> dead, bool of_dead,
                      const auto& draw) {
  std::set<std::pair<double, double>> drawn;
  std::string svg;
  for (const Site& site : sites(skin)) {
    const bool is_dead = std::find(dead.begin(), dead.end(), site.taxel) != dead.end();
    if (is_dead == of_dead && drawn.emplace(site.y, site.z).second) svg += draw(site.y, site.z);
  }
  return svg + '\n';
}

/// The crosses alone.
std::string map_dead_taxels(const MapGrid& grid, const SkinArray& skin,
                            std::span<const std::size_t> dead) {
  if (dead.empty()) return {};
  const double arm = 1.5 * taxel_radius(skin);
  const std::string wide = px(2.0 * arm);
  return at_taxels(skin, dead, true, [&](double y, double z) {
    return "<path class=\"taxel-dead\" d=\"M" + px(grid.across(y) - arm) + ' ' +
           px(grid.down(z) - arm) + 'l' + wide + ' ' + wide + "m0 -" + wide + "l-" + wide + ' ' +
           wide + "\"/>";
  });
}

}  // namespace

std::string map_taxels(const MapGrid& grid, const SkinArray& skin,
                       std::span<const std::size_t> dead) {
  if (taxel_count(skin) > most_dots) return map_dead_taxels(grid, skin, dead);
  const std::string radius = px(taxel_radius(skin));
  return at_taxels(skin, dead, false,
                   [&](double y, double z) {
                     return "<circle class=\"taxel-dot\" cx=\"" + px(grid.across(y)) + "\" cy=\"" +
                            px(grid.down(z)) + "\" r=\"" + radius + "\"/>";
                   }) +
         map_dead_taxels(grid, skin, dead);
}

std::string map_picture(const std::optional<Units>& units, const MapGrid& grid,
                        std::string_view title, std::string_view label, const std::string& inside) {
  const auto from_y = grid.first_y - 0.5 * grid.spacing_y;
  const auto to_y = from_y + grid.spacing_y * static_cast<double>(grid.rows);
  const auto from_z = grid.first_z - 0.5 * grid.spacing_z;
  const auto to_z = from_z + grid.spacing_z * static_cast<double>(grid.columns);
  const double largest =
      std::max({std::abs(from_y), std::abs(to_y), std::abs(from_z), std::abs(to_z)});
  const ScaledUnit unit = report::axis_unit(units, Dimension::length, largest);
  const auto tick = [&](double value) { return brief(value * unit.factor); };
  const std::string name = units ? ' ' + unit.label : std::string{};
  return map_picture(grid,
                     {.left = tick(from_y),
                      .across = "y →",
                      .right = tick(to_y) + name,
                      .top = tick(from_z),
                      .down = "z ↓",
                      .bottom = tick(to_z)},
                     title, label, inside);
}

std::string map_picture(const MapGrid& grid, const MapEnds& ends, std::string_view title,
                        std::string_view label, const std::string& inside) {
  std::string html = title.empty() ? "" : element("p", title, "map-title");
  html += "<div class=\"map\"><div class=\"ticks\">" + element("span", ends.top) +
          element("span", ends.down) + element("span", ends.bottom) + "</div><svg viewBox=\"0 0 " +
          px(MapGrid::width) + ' ' + px(grid.height()) + "\" role=\"img\" aria-label=\"" +
          escaped(label) + "\">\n" + inside + "</svg><i></i><div class=\"ends\">" +
          element("span", ends.left) + element("span", ends.across) + element("span", ends.right) +
          "</div></div>\n";
  return html;
}

std::string colour_bar(MapColours colours, const ScaledUnit& unit, double most, bool negative,
                       const std::string& arrow) {
  const Stops stops = stops_of(colours);
  const auto shown = [&](std::span<const Colour> all) {
    return colours == MapColours::signed_values && !negative ? all.last((all.size() + 1) / 2) : all;
  };
  const auto bar = [&](std::string_view type, std::span<const Colour> all) {
    return "<span class=\"ramp " + std::string(type) +
           "\" style=\"background:" + gradient(shown(all)) + "\"></span>";
  };
  const bool both = colours == MapColours::signed_values && negative;
  const auto number = [&](double value) { return typeset(brief(value * unit.factor)); };
  std::string html = "<div class=\"colours\">" + element("span", both ? number(-most) : "0") +
                     bar("in-light", stops.light) + bar("in-dark", stops.dark) +
                     element("span", number(most) + (unit.label.empty() ? "" : ' ' + unit.label));
  if (!arrow.empty())
    html +=
        "<span class=\"arrow-key\"><svg viewBox=\"0 0 40 14\" aria-hidden=\"true\"><path "
        "class=\"arrow\" d=\"M1 7h37m-9 -5l9 5l-9 5\"/></svg> " +
        escaped(typeset(arrow)) + "</span>";
  return html + "</div>\n";
}

}  // namespace tactile_net::pages
