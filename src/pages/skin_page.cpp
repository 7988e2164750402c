#include "tactile_net/pages/skin_page.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "pages/parts.hpp"
#include "pages/skin_map.hpp"
#include "pages/skin_section.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::figure_html;

using Values = std::vector<double>;

double largest(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

/// What a map of tractions is drawn with: one scale for found and true, so that they compare.
struct Scales {
  double pressure = 0.0;
  double drag = 0.0;
  bool negative = false;
};

double largest_drag(const Values& values, const SkinGrid& grid) {
  const auto y = lab::component(values, grid, SkinTraction::tangential_y);
  const auto z = lab::component(values, grid, SkinTraction::tangential_z);
  double most = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) most = std::max(most, std::hypot(y[i], z[i]));
  return most;
}

Scales scales_of(const lab::SkinExperiment& experiment) {
  const SkinGrid& grid = experiment.grid;
  Scales scales;
  const auto take = [&](const Values& values) {
    const auto p = lab::component(values, grid, SkinTraction::normal);
    scales.pressure = std::max(scales.pressure, largest(p));
    scales.drag = std::max(scales.drag, largest_drag(values, grid));
    scales.negative =
        scales.negative || *std::min_element(p.begin(), p.end()) < -0.03 * scales.pressure;
  };
  take(experiment.frame.truth);
  take(experiment.answer->tractions);
  return scales;
}

std::string traction_map(const lab::SkinExperiment& experiment, const Values& values,
                         const Scales& scales, const std::string& title) {
  const MapGrid grid = map_grid(experiment.grid);
  const auto of = [&](SkinTraction which) {
    return lab::component(values, experiment.grid, which);
  };
  std::string svg =
      map_image(grid, of(SkinTraction::normal), scales.pressure, MapColours::signed_values) +
      map_taxels(grid, experiment.scene.sensor);
  if (scales.drag > 0.02 * scales.pressure && !of(SkinTraction::tangential_y).empty())
    svg += map_arrows(grid, of(SkinTraction::tangential_y), of(SkinTraction::tangential_z),
                      scales.drag);
  return map_picture(experiment.scene.units, grid, title, "Map of the tractions, " + title, svg);
}

std::string maps(const std::vector<std::string>& pictures) {
  std::string html = "<div class=\"maps\">";
  for (const std::string& picture : pictures) html += "<div>" + picture + "</div>";
  return html + "</div>\n";
}

std::string tractions_figure(const lab::SkinExperiment& experiment) {
  const Scales scales = scales_of(experiment);
  if (!(scales.pressure > 0.0)) return {};
  const auto& units = experiment.scene.units;
  const bool arrows = scales.drag > 0.02 * scales.pressure;
  return figure_html(
      "tractions",
      maps({traction_map(experiment, experiment.frame.truth, scales, "What presses"),
            traction_map(experiment, experiment.answer->tractions, scales, "What was found")}) +
          colour_bar(
              MapColours::signed_values,
              report::axis_unit(units, Dimension::stress, scales.pressure), scales.pressure,
              scales.negative,
              arrows ? "drag of " + report::in_unit(units, Dimension::stress, scales.drag) : ""),
      std::string("Seen from outside: colours are the pressure, mean of each cell") +
          (arrows ? ", arrows the drag" : "") +
          ", dots the taxels. Both maps have one scale. What is narrower than the taxels are deep "
          "is smoothed, for the pad itself hides it.",
      "tractions.csv", "whole-row");
}

std::string errors_figure(const lab::SkinExperiment& experiment) {
  const SkinGrid& cells = experiment.grid;
  const MapGrid grid = map_grid(cells);
  const auto& units = experiment.scene.units;
  const auto p = lab::component(experiment.answer->tractions, cells, SkinTraction::normal);
  const auto truth = lab::component(experiment.frame.truth, cells, SkinTraction::normal);
  Values off(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) off[i] = p[i] - truth[i];
  const double most = largest(off);
  if (!(most > 0.0)) return {};
  std::vector<std::string> pictures;
  const auto deviation = lab::component(experiment.answer->deviations, cells, SkinTraction::normal);
  if (!deviation.empty()) {
    const double widest = largest(deviation);
    pictures.push_back(map_picture(units, grid, "How far p may be off: one standard deviation",
                                   "Map of the deviation of the pressure",
                                   map_image(grid, deviation, widest, MapColours::sizes) +
                                       map_taxels(grid, experiment.scene.sensor)) +
                       colour_bar(MapColours::sizes,
                                  report::axis_unit(units, Dimension::stress, widest), widest,
                                  false, ""));
  }
  pictures.push_back(map_picture(units, grid, "How far p is off: found minus true",
                                 "Map of the pressure's error",
                                 map_image(grid, off, most, MapColours::signed_values) +
                                     map_taxels(grid, experiment.scene.sensor)) +
                     colour_bar(MapColours::signed_values,
                                report::axis_unit(units, Dimension::stress, most), most, true, ""));
  return figure_html("errors", maps(pictures),
                     "A ring of both colours around a contact is its edge, smoothed. Errors all "
                     "over the skin are noise, and a larger alpha lowers them.",
                     "tractions.csv", "whole-row");
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
      "tractions.csv", "whole-row");
}

std::string pad_figure(const lab::SkinExperiment& experiment) {
  return figure_html("pad", pad_picture(experiment),
                     "The pad to scale, cut along y through the peak. On top what presses and "
                     "drags, true; inside, the stress across the surface that it causes, which is "
                     "what smooths: blue presses, red pulls. The taxels of all rows are drawn in "
                     "one plane.",
                     "tractions.csv", "whole-row");
}

Dimension dimension_of(SkinQuantity quantity) {
  switch (traits(quantity).kind) {
    case QuantityKind::stress:
      return Dimension::stress;
    case QuantityKind::displacement:
      return Dimension::length;
    case QuantityKind::strain:
      break;
  }
  return Dimension::none;
}

/// Small maps, one for each channel of an even skin.
std::string readings_figure(const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  if (!is_even(scene.sensor)) return {};
  const MapGrid grid = map_grid(scene.sensor);
  std::string pictures;
  for (const SkinChannel& channel : channels(scene.sensor)) {
    const auto values =
        std::span<const double>(experiment.frame.readings).subspan(channel.first, channel.count);
    const double most = largest(values);
    if (!(most > 0.0)) continue;
    const std::string depth = report::in_unit(scene.units, Dimension::length, channel.depth);
    pictures += "<div>" +
                map_picture(scene.units, grid, std::string(name(channel.quantity)) + " at " + depth,
                            "Map of the readings " + channel.name,
                            map_image(grid, values, most, MapColours::signed_values)) +
                colour_bar(MapColours::signed_values,
                           report::axis_unit(scene.units, dimension_of(channel.quantity), most),
                           most, true, "") +
                "</div>";
  }
  return element("h2", "The readings") +
         figure_html("readings", "<div class=\"maps small\">" + pictures + "</div>",
                     "What the taxels read, a square each: all that the answer is made of. Blue is "
                     "compression, or along +y and +z.",
                     "readings.csv", "whole-row");
}

std::string judgement(const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  const lab::SkinAnswer& answer = *experiment.answer;
  std::string html =
      element("h2", "Found beside true") + drawing::html_table(report::found_cells(experiment));
  html += "<p>" + verdict_mark(std::string(name(answer.verdict))) + " " +
          drawing::escaped(drawing::typeset("alpha " + brief(answer.alpha.value) + " (" +
                                            std::string(source(answer.alpha)) + "), " +
                                            report::grid_in_words(scene, experiment.grid) + ".")) +
          "</p>\n";
  if (answer.cone)
    html += element("p", "Under the constraints " + std::to_string(answer.cone->sliding) +
                             " cells slide, " + std::to_string(answer.cone->sticking) + " stick, " +
                             std::to_string(answer.cone->apart) + " touch nothing; found in " +
                             std::to_string(answer.cone->iterations) + " iterations.");
  return html;
}

std::string scene_html(const SkinScene& scene) {
  return element("p", "Sensor: " + report::sensor_in_words(scene) +
                          ". Material: " + report::material_in_words(scene) +
                          ". Forward model: " + std::string(name(scene.forward)) + ".") +
         drawing::html_list(report::contacts_in_words(scene));
}

}  // namespace

drawing::Page run_page(const lab::SkinExperiment& experiment, const std::string& by) {
  const SkinScene& scene = experiment.scene;
  drawing::Page page{.files = report::run_files(experiment)};
  std::string html =
      heading(scene.title, scene.file,
              report::sensor_in_words(scene) + "; " + report::material_in_words(scene));
  html += answer_box(report::answers(experiment));
  html += paragraphs(report::warnings(experiment), "note");
  if (experiment.answer) {
    html += tractions_figure(experiment) + sections_figure(experiment) + errors_figure(experiment) +
            pad_figure(experiment) + judgement(experiment);
  } else {
    html += element("p", experiment.refusal, "bad");
  }
  html += readings_figure(experiment);
  html += colophon("The scene, the files, the command", scene_html(scene), page.files,
                   Made{.by = by, .files = {"result.json"}});
  page.html = page_html(scene.file + " - tactile-net", html);
  return page;
}

}  // namespace tactile_net::pages
