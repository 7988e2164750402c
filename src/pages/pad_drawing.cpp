#include "pages/pad_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "pages/frames_section.hpp"
#include "pages/pixel_text.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/lab/interior.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;

/// What a section shows, of a line's pad or of a skin's.
struct PadSection {
  double middle = 0.0;      ///< y of the surface's middle [m]
  double half_width = 0.0;  ///< [m]
  double bottom = 0.0;      ///< depth that is drawn [m]
  std::optional<Units> units{};
  std::optional<Layer> layer{};
  std::vector<Site> sites{};
  std::string deep{};    ///< what is below, without a layer
  std::string depths{};  ///< of the taxels

  [[nodiscard]] std::string length(double value) const {
    return report::in_unit(units, Dimension::length, value);
  }
  [[nodiscard]] std::vector<std::string> ends() const {
    return {"y = " + length(middle - half_width), middle == 0.0 ? "0" : length(middle),
            length(middle + half_width)};
  }
};

PadSection pad_section(const Scene& scene) {
  const Surface places = surface(scene);
  return {.middle = places.centre,
          .half_width = places.half_width(),
          .bottom = lab::interior_depth(scene),
          .units = scene.units,
          .layer = scene.material.layer,
          .sites = sites(scene.sensor),
          .deep = "deep: a half plane",
          .depths = "taxels at depth x = " + report::depths_in_words(scene)};
}

PadSection pad_section(const SkinScene& scene, const SurfaceGrid& grid) {
  PadSection section{.middle = grid.centre_y,
                     .half_width = 0.5 * grid.spacing_y * static_cast<double>(grid.rows),
                     .units = scene.units,
                     .layer = scene.material.layer,
                     .sites = sites(scene.sensor),
                     .deep = "deep: a half space"};
  double deepest = 0.0;
  for (const Site& site : section.sites) deepest = std::max(deepest, site.depth);
  section.bottom = section.layer ? section.layer->thickness : 2.0 * deepest;
  section.depths =
      (scene.sensor.depths.size() == 1 ? "taxels at depth x = " : "taxels down to x = ") +
      section.length(deepest);
  return section;
}

std::string draw_pad(const PadSection& pad, bool loaded) {
  constexpr double surface = 110.0;  // y of the surface: above it loads are drawn
  const double scale = 500.0 / pad.half_width;
  const double thickness = std::clamp(scale * pad.bottom, 90.0, 420.0);
  const double top = loaded ? 0.0 : surface - 40.0;
  const std::string box =
      "x=\"0\" y=\"" + px(surface) + "\" width=\"1000\" height=\"" + px(thickness) + '"';
  const auto line = [](std::string_view type, double y) {
    return "<line class=\"" + std::string(type) + "\" x1=\"0\" x2=\"1000\" y1=\"" + px(y) +
           "\" y2=\"" + px(y) + "\"/>\n";
  };
  const auto letter = [](double x, double y, std::string_view words) {
    return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\">" + std::string(words) + "</text>\n";
  };
  std::string svg = "<svg class=\"section\" viewBox=\"-34 " + px(top) + " 1078 " +
                    px(surface + thickness + 4.0 - top) +
                    "\" role=\"img\" aria-label=\"Section of the pad: taxels below the surface" +
                    (loaded ? ", tractions on top" : "") + "\">\n<rect class=\"pad\" " + box +
                    "/>\n";
  if (loaded)
    svg += "<image data-part=\"inside\" data-depth=\"" + shortest(pad.bottom) + "\" " + box +
           " preserveAspectRatio=\"none\"/>\n";
  std::set<double> places;
  for (const Site& site : pad.sites) places.insert(site.y);
  const double radius = std::clamp(300.0 / static_cast<double>(places.size()), 1.2, 4.0);
  std::set<std::pair<double, double>> drawn;  // several quantities may be read at one place
  for (const Site& site : pad.sites)
    if (drawn.emplace(site.y, site.depth).second) {
      const double half = std::max(0.5 * site.width * scale, radius);
      svg += "<rect class=\"taxel\" x=\"" + px(500.0 + scale * (site.y - pad.middle) - half) +
             "\" y=\"" + px(surface + thickness * site.depth / pad.bottom - radius) +
             "\" width=\"" + px(2.0 * half) + "\" height=\"" + px(2.0 * radius) + "\" rx=\"" +
             px(radius) + "\"/>";
    }
  svg += '\n' + line("surface", surface);
  if (pad.layer) svg += line("base", surface + thickness);
  svg += "<g class=\"axis\"><path d=\"M-12 " + px(surface) +
         "v46m-5 -9l5 9l5 -9\"/><path d=\"M968 " + px(surface - 8.0) +
         "h40m-9 -5l9 5l-9 5\"/></g>\n" + letter(-20.0, surface + 76.0, "x") +
         letter(1016.0, surface - 1.0, "y");
  if (loaded)
    svg +=
        "<path class=\"pressure\" data-part=\"pressure\"/><path class=\"drag\" "
        "data-part=\"drag\"/>\n";
  std::string ends;
  for (const std::string& end : pad.ends()) ends += element("span", end);
  return svg + "</svg>\n<div class=\"pad-words\">" + ends + "</div><div class=\"pad-words\">" +
         element("span", !pad.layer
                             ? pad.deep
                             : pad.length(pad.layer->thickness) + " thick, " +
                                   (pad.layer->base == Base::bonded ? "bonded to a rigid base"
                                                                    : "slides on a rigid base")) +
         element("span", pad.depths) + "</div>\n";
}

/// What stands on the pad: the truth where it is known.
const std::vector<double>& shown(const lab::Experiment& experiment) {
  return experiment.has_truth() ? experiment.frame.truth
                                : experiment.results.front().answer.tractions;
}

/// stress_x below the cells of a column, row by row from the surface. Points lie on the lattice of
/// the cells or of their halves, so that few distances occur, and the kernel is asked once for
/// each.
std::vector<double> stress_below(const lab::Experiment& experiment, std::size_t rows, double bottom,
                                 std::size_t column) {
  const SurfaceGrid& grid = experiment.grid;
  const std::size_t per_cell = grid.rows <= 32 ? 2 : 1;
  const std::size_t points = per_cell * grid.rows;
  const double step = grid.spacing_y / static_cast<double>(per_cell);
  const std::size_t last = per_cell * (grid.rows - 1);  // the first point of the last row of cells
  std::vector<double> stress(rows * points);
  std::vector<double> by_distance(last + points);
  for (std::size_t i = 0; i < rows; ++i) {
    const SkinKernel kernel(experiment.skin().material,
                            bottom * (static_cast<double>(i) + 0.5) / static_cast<double>(rows));
    for (const Traction which : skin_tractions) {
      const auto values = lab::component(shown(experiment), grid, which);
      for (std::size_t of = 0; !values.empty() && of < grid.columns; ++of) {
        for (std::size_t d = 0; d < by_distance.size(); ++d)
          by_distance[d] =
              kernel(Quantity::stress_x, which, {grid.spacing_y, grid.spacing_z},
                     step * (static_cast<double>(d) - static_cast<double>(last) + 0.5) -
                         0.5 * grid.spacing_y,
                     grid.z(column) - grid.z(of));
        for (std::size_t row = 0; row < grid.rows; ++row)
          for (std::size_t j = 0; j < points; ++j)
            stress[i * points + j] +=
                values[row * grid.columns + of] * by_distance[j + last - per_cell * row];
      }
    }
  }
  return stress;
}

/// The column of the cell where the answer presses hardest.
std::size_t peak_column(const lab::Experiment& experiment) {
  const auto p = lab::component(experiment.results.front().answer.tractions, experiment.grid,
                                Traction::normal);
  return static_cast<std::size_t>(std::max_element(p.begin(), p.end()) - p.begin()) %
         experiment.grid.columns;
}

bool presses(std::span<const double> normal) {
  return std::any_of(normal.begin(), normal.end(), [](double p) { return p != 0.0; });
}

}  // namespace

std::vector<std::string> ends_of_surface(const Scene& scene) { return pad_section(scene).ends(); }

std::string draw_pad(const Scene& scene, bool loaded) {
  return draw_pad(pad_section(scene), loaded);
}

drawing::Figure pad_figure(const Scene& scene, const PadLoad& load, std::string_view on_top,
                           std::string_view section, std::string_view data) {
  const bool loaded = presses(load.normal);
  std::string picture = draw_pad(scene, loaded);
  if (loaded) {
    std::vector<double> tractions(load.normal.begin(), load.normal.end());
    tractions.insert(tractions.end(), load.tangential.begin(), load.tangential.end());
    report::ShownLoad shown{.grid = report::ShownLoad::grid_of(surface(scene)),
                            .units = scene.units,
                            .tractions = tractions,
                            .is_line = true};
    std::vector<double> stress;
    if (load.normal.size() <= 1024) {
      shown.rows = 18;
      stress =
          lab::interior_stress(lab::interior_kernels(scene, shown.rows, !load.tangential.empty()),
                               load.normal, load.tangential);
      shown.stress = stress;
    }
    picture = drawn_load(view_of_pad(picture), shown);
  }
  return {.name = "pad",
          .section = std::string(section),
          .caption = !loaded ? "The pad in section, to scale: the taxels lie at their depth, and "
                               "nothing presses."
                             : "The pad in section, to scale. On top " + std::string(on_top) +
                                   "; inside, the stress across the surface that they cause, which "
                                   "is what smooths: blue presses, red pulls. The pointer tells "
                                   "what is under it.",
          .plot = {},
          .picture = std::move(picture),
          .data = std::string(data)};
}

std::string pad_picture(const lab::Experiment& experiment) {
  const SurfaceGrid& grid = experiment.grid;
  const PadSection pad = pad_section(experiment.skin(), grid);
  const std::size_t column = peak_column(experiment);
  std::vector<double> tractions;  // along y: of the cells through the peak
  for (const Traction which : {Traction::normal, Traction::tangential_y}) {
    const auto all = lab::component(shown(experiment), grid, which);
    for (std::size_t i = column; i < all.size(); i += grid.columns) tractions.push_back(all[i]);
  }
  if (!presses(std::span(tractions).first(grid.rows))) return draw_pad(pad, false);
  report::ShownLoad load{.grid = grid,
                         .units = experiment.skin().units,
                         .tractions = tractions,
                         .is_line = true,
                         .rows = pad.layer ? std::size_t{8} : std::size_t{16}};
  load.grid.columns = 1;
  const std::vector<double> stress = stress_below(experiment, load.rows, pad.bottom, column);
  load.stress = stress;
  return drawn_load(view_of_pad(draw_pad(pad, true)), load);
}

}  // namespace tactile_net::pages
