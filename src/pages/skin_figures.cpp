#include "pages/skin_figures.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "pages/parts.hpp"
#include "pages/skin_section.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/contact_words.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::figure_html;
using Values = std::vector<double>;

double largest_finite(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

double largest_drag(const Values& values, const SurfaceGrid& grid) {
  const auto y = lab::component(values, grid, Traction::tangential_y);
  const auto z = lab::component(values, grid, Traction::tangential_z);
  double most = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) most = std::max(most, std::hypot(y[i], z[i]));
  return most;
}

}  // namespace

void take(Scales& scales, const Values& values, const SurfaceGrid& grid) {
  const auto p = lab::component(values, grid, Traction::normal);
  scales.pressure = std::max(scales.pressure, largest_finite(p));
  scales.drag = std::max(scales.drag, largest_drag(values, grid));
  scales.negative =
      scales.negative || *std::min_element(p.begin(), p.end()) < -0.03 * scales.pressure;
}

std::string traction_map(const SkinScene& scene, const SurfaceGrid& cells, const Values& values,
                         const Scales& scales) {
  const MapGrid grid = map_grid(cells);
  const auto of = [&](Traction which) { return lab::component(values, cells, which); };
  std::string svg =
      map_image(grid, of(Traction::normal), scales.pressure, MapColours::signed_values) +
      map_taxels(grid, scene.sensor, scene.dead_taxels);
  if (scales.drag > least_drag * scales.pressure && !of(Traction::tangential_y).empty())
    svg += map_arrows(grid, of(Traction::tangential_y), of(Traction::tangential_z), scales.drag);
  return map_picture(scene.units, grid, "", "Map of the tractions", svg);
}

std::string traction_bar(const SkinScene& scene, const Scales& scales) {
  const auto& units = scene.units;
  return colour_bar(MapColours::signed_values,
                    report::axis_unit(units, Dimension::stress, scales.pressure), scales.pressure,
                    scales.negative,
                    scales.drag > least_drag * scales.pressure
                        ? "drag of " + report::in_unit(units, Dimension::stress, scales.drag)
                        : "");
}

std::string scene_html(const SkinScene& scene) {
  return element("p", "Sensor: " + report::sensor_in_words(scene) +
                          ". Material: " + report::material_in_words(scene) +
                          ". Forward model: " + std::string(name(scene.forward)) + ".") +
         drawing::html_list(report::contacts_in_words(scene));
}

std::string maps(const std::vector<std::string>& pictures) {
  std::string html = "<div class=\"maps\">";
  for (const std::string& picture : pictures) html += "<div>" + picture + "</div>";
  return html + "</div>\n";
}

namespace {

std::string pad_section_figure(const lab::SkinExperiment& experiment) {
  return figure_html(
      "pad", pad_picture(experiment),
      std::string("The pad to scale, cut along y through the peak. On top what presses and "
                  "drags, ") +
          (experiment.has_truth() ? "true" : "as found") +
          "; inside, the stress across the surface that it causes, which is "
          "what smooths: blue presses, red pulls. The taxels of all rows are drawn in "
          "one plane.",
      "tractions.csv", "skin");
}

std::string judgement(const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  const lab::FrameAnswer& answer = *experiment.answer;
  std::string html =
      element("h2", experiment.has_truth() ? "Found beside true" : "What was found") +
      drawing::html_table(report::found_cells(experiment));
  if (const auto rows = report::patch_cells(scene.units, answer.patches); !rows.empty())
    html += element("p", "Each contact by itself:") + drawing::html_table(rows);
  html += "<p>" + verdict_mark(std::string(name(answer.verdict))) + " " +
          drawing::escaped(drawing::typeset(
              "alpha " + brief(answer.alpha.value) + " (" + std::string(source(answer.alpha)) +
              "), " + report::grid_in_words(scene, experiment.grid) +
              ". Data: " + report::data_word(*answer.data, scene) + ".")) +
          "</p>\n";
  if (answer.cone)
    html += element("p", "Under the constraints " + std::to_string(answer.cone->slip) +
                             " cells slide, " + std::to_string(answer.cone->stick) + " stick, " +
                             std::to_string(answer.cone->separation) + " touch nothing; found in " +
                             std::to_string(answer.cone->iterations) + " iterations.");
  return html;
}

}  // namespace

std::string frame_html(const lab::SkinExperiment& experiment) {
  return pad_section_figure(experiment) + judgement(experiment);
}

}  // namespace tactile_net::pages
