#include "pages/skin_section.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pages/pixel_text.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/drawing/png.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/skin/forward.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;

/// One component along the line of cells through the peak.
std::vector<double> along_y(const std::vector<double>& values, const SurfaceGrid& grid,
                            Traction which, std::size_t column) {
  const auto all = lab::component(values, grid, which);
  std::vector<double> line;
  if (all.empty()) return line;
  for (std::size_t row = 0; row < grid.rows; ++row)
    line.push_back(all[row * grid.columns + column]);
  return line;
}

/// Depths and places of the picture's points inside the pad, and the stress there.
struct Interior {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> stress{};  ///< row by row from the surface
};

/// What stands on the pad: the truth where it is known.
const std::vector<double>& shown(const lab::SkinExperiment& experiment) {
  return experiment.has_truth() ? experiment.frame.truth : experiment.answer->tractions;
}

/// That as a load.
SampledPatch patch_of(const lab::SkinExperiment& experiment) {
  const SurfaceGrid& grid = experiment.grid;
  SampledPatch patch{.rows = grid.rows,
                     .columns = grid.columns,
                     .y = grid.centre_y,
                     .z = grid.centre_z,
                     .spacing_y = grid.spacing_y,
                     .spacing_z = grid.spacing_z};
  const auto take = [&](Traction which) {
    const auto all = lab::component(shown(experiment), grid, which);
    return std::vector(all.begin(), all.end());
  };
  patch.normal = take(Traction::normal);
  patch.tangential_y = take(Traction::tangential_y);
  patch.tangential_z = take(Traction::tangential_z);
  return patch;
}

Interior interior_of(const lab::SkinExperiment& experiment, double bottom, double z) {
  const SkinScene& scene = experiment.scene;
  const SurfaceGrid& grid = experiment.grid;
  Interior interior{.rows = scene.material.layer ? std::size_t{8} : std::size_t{16},
                    .columns = std::min<std::size_t>(2 * grid.rows, 64)};
  const double width = grid.spacing_y * static_cast<double>(grid.rows);
  std::vector<Taxel> points;
  for (std::size_t i = 0; i < interior.rows; ++i)
    for (std::size_t j = 0; j < interior.columns; ++j)
      points.push_back(
          {.y = grid.centre_y +
                centred(j, interior.columns) * width / static_cast<double>(interior.columns),
           .z = z,
           .depth = bottom * (static_cast<double>(i) + 0.5) / static_cast<double>(interior.rows),
           .reads = {Quantity::stress_x}});
  const SkinLoad load = patch_of(experiment);
  interior.stress =
      exact_readings(uneven_skin(std::move(points)), scene.material, std::span(&load, 1));
  return interior;
}

/// The column of the cell where the answer presses hardest.
std::size_t peak_column(const lab::SkinExperiment& experiment) {
  const auto& values = experiment.answer ? experiment.answer->tractions : experiment.frame.truth;
  const auto p = lab::component(values, experiment.grid, Traction::normal);
  const auto at = static_cast<std::size_t>(std::max_element(p.begin(), p.end()) - p.begin());
  return at % experiment.grid.columns;
}

}  // namespace

std::string pad_picture(const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  const SurfaceGrid& grid = experiment.grid;
  const std::size_t column = peak_column(experiment);
  const double deepest = [&] {
    double most = 0.0;
    for (const Site& site : sites(scene.sensor)) most = std::max(most, site.depth);
    return most;
  }();
  const double bottom = scene.material.layer ? scene.material.layer->thickness : 2.0 * deepest;
  const double scale = 1000.0 / (grid.spacing_y * static_cast<double>(grid.rows));
  const double thickness = std::clamp(scale * bottom, 90.0, 420.0);
  const double surface = 120.0;
  const auto at = [&](double y) { return 500.0 + scale * (y - grid.centre_y); };
  std::string svg = "<svg class=\"section\" viewBox=\"-34 0 1078 " + px(surface + thickness + 4.0) +
                    "\" role=\"img\" aria-label=\"Section of the pad along y through the peak\">\n";
  svg += "<rect class=\"pad\" x=\"0\" y=\"" + px(surface) + "\" width=\"1000\" height=\"" +
         px(thickness) + "\"/>\n";
  const auto p = along_y(shown(experiment), grid, Traction::normal, column);
  const double most = *std::max_element(p.begin(), p.end());
  if (most > 0.0) {
    const Interior inside = interior_of(experiment, bottom, grid.z(column));
    std::vector<std::uint8_t> pixels;
    for (const double stress : inside.stress)
      pixels.push_back(drawing::diverging_index(stress / most));
    svg += "<image x=\"0\" y=\"" + px(surface) + "\" width=\"1000\" height=\"" + px(thickness) +
           "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," +
           drawing::base64(drawing::png(inside.columns, inside.rows, pixels,
                                        drawing::diverging({192, 57, 43}, {33, 102, 172}))) +
           "\"/>\n";
  }
  std::set<std::pair<double, double>> drawn;
  for (const Site& site : sites(scene.sensor))
    if (drawn.emplace(site.y, site.depth).second)
      svg += "<circle class=\"taxel\" cx=\"" + px(at(site.y)) + "\" cy=\"" +
             px(surface + thickness * site.depth / bottom) + "\" r=\"5\"/>";
  const auto line = [&](const char* type, double y) {
    return "<line class=\"" + std::string(type) + "\" x1=\"0\" x2=\"1000\" y1=\"" + px(y) +
           "\" y2=\"" + px(y) + "\"/>\n";
  };
  svg += '\n' + line("surface", surface);
  if (scene.material.layer) svg += line("base", surface + thickness);
  if (most > 0.0) {
    std::string area = "M0 " + px(surface);
    for (std::size_t i = 0; i < p.size(); ++i)
      area += 'L' + px(at(grid.y(i))) + ' ' + px(surface - 90.0 * std::max(p[i], 0.0) / most);
    svg += "<path class=\"pressure\" d=\"" + area + "L1000 " + px(surface) + "Z\"/>\n";
    const auto q = along_y(shown(experiment), grid, Traction::tangential_y, column);
    std::string arrows;
    for (std::size_t i = 0; i < q.size(); ++i) {
      const double length = 60.0 * q[i] / most;
      if (std::abs(length) < 3.0) continue;
      const double head = std::copysign(std::min(8.0, 0.6 * std::abs(length)), length);
      arrows += 'M' + px(at(grid.y(i)) - 0.5 * length) + ' ' + px(surface - 6.0) + 'h' +
                px(length) + 'm' + px(-head) + " -5l" + px(head) + " 5l" + px(-head) + " 5";
    }
    if (!arrows.empty()) svg += "<path class=\"drag\" d=\"" + arrows + "\"/>\n";
  }
  svg += "<g class=\"axis\"><path d=\"M-12 " + px(surface) +
         "v46m-5 -9l5 9l5 -9\"/><path d=\"M968 " + px(surface - 8.0) +
         "h40m-9 -5l9 5l-9 5\"/></g><text x=\"-20\" y=\"" + px(surface + 76.0) +
         "\">x</text><text x=\"1016\" y=\"" + px(surface - 1.0) + "\">y</text></svg>\n";
  const auto length = [&](double value) {
    return report::in_unit(scene.units, Dimension::length, value);
  };
  const double half = 0.5 * grid.spacing_y * static_cast<double>(grid.rows);
  const auto& layer = scene.material.layer;
  return svg + "<div class=\"pad-words\">" +
         element("span", "y = " + length(grid.centre_y - half)) +
         element("span", length(grid.centre_y + half)) + "</div><div class=\"pad-words\">" +
         element("span", !layer ? "deep: a half space"
                                : length(layer->thickness) + " thick, " +
                                      (layer->base == Base::bonded ? "bonded to a rigid base"
                                                                   : "slides on a rigid base")) +
         element("span", scene.sensor.depths.size() == 1
                             ? "taxels at depth x = " + length(deepest)
                             : "taxels down to x = " + length(deepest)) +
         "</div>\n";
}

}  // namespace tactile_net::pages
