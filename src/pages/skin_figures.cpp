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

std::string traction_map(const SkinScene& scene, const SurfaceGrid& cells_of, const Values& values,
                         const std::vector<std::size_t>& cells, const Scales& scales,
                         const std::string& title) {
  const MapGrid grid = map_grid(cells_of);
  const auto of = [&](Traction which) { return lab::component(values, cells_of, which); };
  std::string svg =
      map_image(grid, of(Traction::normal), scales.pressure, MapColours::signed_values) +
      map_taxels(grid, scene.sensor, scene.dead_taxels);
  std::vector<bool> touches(cells_of.count());
  for (const std::size_t cell : cells) touches[cell] = true;
  const auto drag = [&](Traction which) {
    const auto values_of = of(which);
    Values shown(values_of.begin(), values_of.end());
    for (std::size_t k = 0; k < shown.size() && !cells.empty(); ++k)
      if (!touches[k]) shown[k] = 0.0;
    return shown;
  };
  if (scales.drag > least_drag * scales.pressure && !of(Traction::tangential_y).empty())
    svg +=
        map_arrows(grid, drag(Traction::tangential_y), drag(Traction::tangential_z), scales.drag);
  svg += map_outline(grid, touches);
  return map_picture(scene.units, grid, title, "Map of the tractions, " + title, svg);
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

std::string readings_figure(const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  if (!is_even(scene.sensor)) return {};
  const MapGrid grid = map_grid(scene.sensor);
  std::string pictures;
  const std::string dead = map_dead_taxels(grid, scene.sensor, scene.dead_taxels);
  for (const Channel& channel : channels(scene.sensor)) {
    const auto values =
        std::span<const double>(experiment.frame.readings).subspan(channel.first, channel.count);
    const double most = largest_finite(values);
    if (!(most > 0.0)) continue;
    const std::string depth = report::in_unit(scene.units, Dimension::length, channel.depth);
    pictures += "<div>" +
                map_picture(scene.units, grid, std::string(name(channel.quantity)) + " at " + depth,
                            "Map of the readings " + channel.name,
                            map_image(grid, values, most, MapColours::signed_values) + dead) +
                colour_bar(MapColours::signed_values,
                           report::axis_unit(scene.units,
                                             dimension_of(traits(channel.quantity).kind), most),
                           most, true, "") +
                "</div>";
  }
  return element("h2", "The readings") +
         figure_html("readings", "<div class=\"maps small\">" + pictures + "</div>",
                     "What the taxels read, a square each: all that the answer is made of. Blue is "
                     "compression, or along +y and +z." +
                         std::string(dead.empty() ? ""
                                                  : " Crosses are dead taxels, which say "
                                                    "nothing."),
                     "readings.csv", "skin");
}

namespace {

Scales scales_of(const lab::SkinExperiment& experiment) {
  Scales scales;
  if (experiment.has_truth()) take(scales, experiment.frame.truth, experiment.grid);
  take(scales, experiment.answer->tractions, experiment.grid);
  return scales;
}

std::string tractions_figure(const lab::SkinExperiment& experiment) {
  const Scales scales = scales_of(experiment);
  if (!(scales.pressure > 0.0)) return {};
  const bool arrows = scales.drag > least_drag * scales.pressure;
  std::vector<std::string> pictures;
  if (experiment.has_truth())
    pictures.push_back(traction_map(experiment.scene, experiment.grid, experiment.frame.truth, {},
                                    scales, "What presses"));
  pictures.push_back(traction_map(experiment.scene, experiment.grid, experiment.answer->tractions,
                                  experiment.answer->cells, scales,
                                  experiment.has_truth() ? "What was found" : ""));
  return figure_html(
      "tractions", maps(pictures) + traction_bar(experiment.scene, scales),
      std::string("Seen from outside: colours are the pressure, mean of each cell") +
          (arrows ? ", arrows the drag" : "") +
          (has_taxel_dots(experiment.scene.sensor) ? ", dots the taxels" : "") +
          (experiment.scene.dead_taxels.empty() ? "" : ", crosses the dead taxels") +
          "; the line runs around the cells that touch, over which forces are "
          "summed. What is narrower than the taxels are deep is smoothed, for the pad itself "
          "hides it.",
      "tractions.csv", "skin");
}

/// How far the pressure may be off, and where the truth is known how far it is.
std::string errors_figure(const lab::SkinExperiment& experiment) {
  const SurfaceGrid& cells = experiment.grid;
  const MapGrid grid = map_grid(cells);
  const auto& units = experiment.scene.units;
  std::vector<std::string> pictures;
  const auto add = [&](const std::string& title, std::span<const double> values,
                       MapColours colours) {
    const double most = largest_finite(values);
    if (!(most > 0.0)) return;
    pictures.push_back(
        map_picture(units, grid, title, title,
                    map_image(grid, values, most, colours) +
                        map_taxels(grid, experiment.scene.sensor, experiment.scene.dead_taxels)) +
        colour_bar(colours, report::axis_unit(units, Dimension::stress, most), most, true, ""));
  };
  add("How far p may be off: one standard deviation",
      lab::component(experiment.answer->deviations, cells, Traction::normal), MapColours::sizes);
  if (experiment.has_truth()) {
    const auto p = lab::component(experiment.answer->tractions, cells, Traction::normal);
    const auto truth = lab::component(experiment.frame.truth, cells, Traction::normal);
    Values off(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) off[i] = p[i] - truth[i];
    add("How far p is off: found minus true", off, MapColours::signed_values);
  }
  if (pictures.empty()) return {};
  return figure_html(
      "errors", maps(pictures),
      experiment.has_truth()
          ? "A ring of both colours around a contact is its edge, smoothed. Errors all over the "
            "skin are noise, and a larger alpha lowers them."
          : "Where taxels tell little it is most: beyond the last of them, and between them.",
      "tractions.csv", "skin");
}

std::string sections_figure(const lab::SkinExperiment& experiment) {
  const bool bands = !experiment.answer->deviations.empty();
  return figure_html(
      "sections",
      maps({section_picture(experiment, Axis::y), section_picture(experiment, Axis::z)}),
      std::string("Two lines through the cell that presses hardest. ") +
          (bands ? "Bands are two standard deviations, of noise and of what alpha smooths away "
                   "together: look for dashes outside of them. "
                 : "") +
          "Values are means over cells.",
      "tractions.csv", "skin");
}

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
  return tractions_figure(experiment) + sections_figure(experiment) + errors_figure(experiment) +
         pad_section_figure(experiment) + judgement(experiment);
}

}  // namespace tactile_net::pages
