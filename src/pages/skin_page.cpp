#include "tactile_net/pages/skin_page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "pages/parts.hpp"
#include "pages/skin_map.hpp"
#include "pages/skin_section.hpp"
#include "pages/time_picture.hpp"
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

/// Drags that are smaller beside the pressure are not drawn: noise has some everywhere.
constexpr double least_drag = 0.1;

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

/// Widens the scales so that these tractions fit.
void take(Scales& scales, const Values& values, const SkinGrid& grid) {
  const auto p = lab::component(values, grid, SkinTraction::normal);
  scales.pressure = std::max(scales.pressure, largest(p));
  scales.drag = std::max(scales.drag, largest_drag(values, grid));
  scales.negative =
      scales.negative || *std::min_element(p.begin(), p.end()) < -0.03 * scales.pressure;
}

Scales scales_of(const lab::SkinExperiment& experiment) {
  Scales scales;
  if (experiment.has_truth()) take(scales, experiment.frame.truth, experiment.grid);
  take(scales, experiment.answer->tractions, experiment.grid);
  return scales;
}

/// @param cells  that touch, around which a line runs, and whose drags are drawn; none: all are
std::string traction_map(const SkinScene& scene, const SkinGrid& cells_of, const Values& values,
                         const std::vector<std::size_t>& cells, const Scales& scales,
                         const std::string& title) {
  const MapGrid grid = map_grid(cells_of);
  const auto of = [&](SkinTraction which) { return lab::component(values, cells_of, which); };
  std::string svg =
      map_image(grid, of(SkinTraction::normal), scales.pressure, MapColours::signed_values) +
      map_taxels(grid, scene.sensor);
  std::vector<bool> touches(cells_of.count());
  for (const std::size_t cell : cells) touches[cell] = true;
  const auto drag = [&](SkinTraction which) {
    const auto values_of = of(which);
    Values shown(values_of.begin(), values_of.end());
    for (std::size_t k = 0; k < shown.size() && !cells.empty(); ++k)
      if (!touches[k]) shown[k] = 0.0;
    return shown;
  };
  if (scales.drag > least_drag * scales.pressure && !of(SkinTraction::tangential_y).empty())
    svg += map_arrows(grid, drag(SkinTraction::tangential_y), drag(SkinTraction::tangential_z),
                      scales.drag);
  svg += map_outline(grid, touches);
  return map_picture(scene.units, grid, title, "Map of the tractions, " + title, svg);
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
  const bool arrows = scales.drag > least_drag * scales.pressure;
  std::vector<std::string> pictures;
  if (experiment.has_truth())
    pictures.push_back(traction_map(experiment.scene, experiment.grid, experiment.frame.truth, {},
                                    scales, "What presses"));
  pictures.push_back(traction_map(experiment.scene, experiment.grid, experiment.answer->tractions,
                                  experiment.answer->cells, scales,
                                  experiment.has_truth() ? "What was found" : ""));
  return figure_html(
      "tractions",
      maps(pictures) +
          colour_bar(
              MapColours::signed_values,
              report::axis_unit(units, Dimension::stress, scales.pressure), scales.pressure,
              scales.negative,
              arrows ? "drag of " + report::in_unit(units, Dimension::stress, scales.drag) : ""),
      std::string("Seen from outside: colours are the pressure, mean of each cell") +
          (arrows ? ", arrows the drag" : "") +
          ", dots the taxels; the line runs around the cells that touch, over which forces are "
          "summed. What is narrower than the taxels are deep is smoothed, for the pad itself "
          "hides it.",
      "tractions.csv", "skin");
}

/// How far the pressure may be off, and where the truth is known how far it is.
std::string errors_figure(const lab::SkinExperiment& experiment) {
  const SkinGrid& cells = experiment.grid;
  const MapGrid grid = map_grid(cells);
  const auto& units = experiment.scene.units;
  std::vector<std::string> pictures;
  const auto add = [&](const std::string& title, std::span<const double> values,
                       MapColours colours) {
    const double most = largest(values);
    if (!(most > 0.0)) return;
    pictures.push_back(
        map_picture(
            units, grid, title, title,
            map_image(grid, values, most, colours) + map_taxels(grid, experiment.scene.sensor)) +
        colour_bar(colours, report::axis_unit(units, Dimension::stress, most), most, true, ""));
  };
  add("How far p may be off: one standard deviation",
      lab::component(experiment.answer->deviations, cells, SkinTraction::normal),
      MapColours::sizes);
  if (experiment.has_truth()) {
    const auto p = lab::component(experiment.answer->tractions, cells, SkinTraction::normal);
    const auto truth = lab::component(experiment.frame.truth, cells, SkinTraction::normal);
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

std::string pad_figure(const lab::SkinExperiment& experiment) {
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
                     "readings.csv", "skin");
}

std::string judgement(const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  const lab::SkinAnswer& answer = *experiment.answer;
  std::string html =
      element("h2", experiment.has_truth() ? "Found beside true" : "What was found") +
      drawing::html_table(report::found_cells(experiment));
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

/// All that is drawn of one frame.
std::string frame_html(const lab::SkinExperiment& experiment) {
  return tractions_figure(experiment) + sections_figure(experiment) + errors_figure(experiment) +
         pad_figure(experiment) + judgement(experiment);
}

/// A value of every frame with its band, as a stretched picture.
std::string course_picture(const lab::SkinRecordingAnswer& recording, const std::string& title,
                           Dimension dimension, std::string_view type,
                           const std::function<std::optional<Uncertain>(std::size_t)>& of) {
  const std::size_t n = recording.frames.size();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto at = [&](std::size_t i, double deviations) {
    const auto one = of(i);
    return one ? one->value + deviations * one->deviation : none;
  };
  Range range;
  for (std::size_t i = 0; i < n; ++i) {
    range.take(at(i, -2.0));
    range.take(at(i, 2.0));
  }
  if (range.empty()) return {};
  const auto& units = recording.scene.units;
  const auto name = [&](std::size_t i) {
    const std::string& time = recording.frames[i].time;
    return time.empty() ? "frame " + std::to_string(i) : "t = " + time;
  };
  return element("p", title, "map-title") +
         stretched_picture(
             n, range, report::axis_unit(units, dimension, std::max(range.high, -range.low)), title,
             "low",
             level_line(n, range, 0.0, "zero") +
                 area_of(
                     n, range, [&](std::size_t i) { return at(i, -2.0); },
                     [&](std::size_t i) { return at(i, 2.0); }, std::string(type) + "-area") +
                 path_of(
                     n, range, [&](std::size_t i) { return at(i, 0.0); }, type),
             {name(0), name(n / 2), name(n - 1)});
}

std::string course_pictures(const lab::SkinRecordingAnswer& recording) {
  const auto wrench = [&](std::size_t i) -> const UncertainWrench& {
    return recording.frames[i].wrench;
  };
  std::vector<std::string> pictures = {
      course_picture(recording, "Force into the skin", Dimension::point_force, "normal",
                     [&](std::size_t i) { return std::optional(wrench(i).normal); })};
  const std::tuple<const char*, Dimension, std::optional<Uncertain> UncertainWrench::*> others[] = {
      {"Drag along y", Dimension::point_force, &UncertainWrench::tangential_y},
      {"Drag along z", Dimension::point_force, &UncertainWrench::tangential_z},
      {"Torsion", Dimension::moment, &UncertainWrench::torsion}};
  for (const auto& [title, dimension, member] : others)
    pictures.push_back(
        course_picture(recording, title, dimension, "tangential",
                       [&, which = member](std::size_t i) { return wrench(i).*which; }));
  std::string html;
  for (const std::string& picture : pictures) html += picture;
  return html;
}

/// Every frame that is kept as a map, one at a time, by a slider.
std::string frames_figure(const lab::SkinRecordingAnswer& recording) {
  if (recording.shown.size() < 2) return {};
  const SkinGrid& grid = recording.grid;
  Scales scales;
  for (const auto& one : recording.shown) take(scales, one.tractions, grid);
  if (!(scales.pressure > 0.0)) return {};
  const auto& units = recording.scene.units;
  std::string html;
  std::size_t first = 0;
  for (std::size_t i = 0; i < recording.shown.size(); ++i)
    if (recording.shown[i].frame == recording.hardest) first = i;
  for (std::size_t i = 0; i < recording.shown.size(); ++i) {
    const auto& one = recording.shown[i];
    const lab::SkinRecordingAnswer::Frame& frame = recording.frames[one.frame];
    const std::string title =
        "Frame " + std::to_string(one.frame) + (frame.time.empty() ? "" : ", t = " + frame.time) +
        ": " +
        report::in_unit(units, Dimension::point_force, frame.wrench.normal.value,
                        frame.wrench.normal.deviation) +
        (frame.verdict == lab::Verdict::ok ? "" : ", " + std::string(name(frame.verdict)));
    html += std::string("<div class=\"frame\"") + (i == first ? ">" : " hidden>") +
            traction_map(recording.scene, grid, one.tractions, one.cells, scales, title) + "</div>";
  }
  const std::string last = std::to_string(recording.shown.size() - 1);
  return figure_html(
      "frames",
      "<div class=\"maps\"><div>" + html + "<input type=\"range\" id=\"frame\" min=\"0\" max=\"" +
          last + "\" value=\"" + std::to_string(first) + "\" aria-label=\"Frame\">" +
          colour_bar(MapColours::signed_values,
                     report::axis_unit(units, Dimension::stress, scales.pressure), scales.pressure,
                     scales.negative,
                     scales.drag > least_drag * scales.pressure
                         ? "drag of " + report::in_unit(units, Dimension::stress, scales.drag)
                         : "") +
          "</div><div>" + course_pictures(recording) +
          "</div></div><script>{const r=document.getElementById('frame'),"
          "f=document.querySelectorAll('.frame');r.oninput=()=>f.forEach((e,i)=>"
          "{e.hidden=i!=r.value})}</script>",
      "Drag the slider through the recording: colours are the pressure, arrows the drag, on one "
      "scale for all frames. Beside it every frame by itself, of the cells that touch; bands are "
      "two standard deviations.",
      "result.json", "skin");
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
    html += frame_html(experiment);
  } else {
    html += element("p", experiment.refusal, "bad");
  }
  html += readings_figure(experiment);
  html += colophon("The scene, the files, the command", scene_html(scene), page.files,
                   Made{.by = by, .files = {"result.json"}});
  page.html = page_html(scene.file + " - tactile-net", html);
  return page;
}

drawing::Page recording_page(const lab::SkinRecordingAnswer& recording, const std::string& readings,
                             const std::string& by) {
  const SkinScene& scene = recording.scene;
  const lab::SkinExperiment hardest{.scene = scene,
                                    .grid = recording.grid,
                                    .frame = {.readings = recording.readings},
                                    .answer = recording.answer};
  drawing::Page page{.files = report::run_files(hardest)};
  std::string html =
      heading(scene.title, scene.file,
              readings + ", " + std::to_string(recording.frames.size()) +
                  (recording.frames.size() == 1 ? " frame; " : " frames; ") +
                  report::sensor_in_words(scene) + "; " + report::material_in_words(scene));
  html += answer_box(report::answers(recording));
  html += paragraphs(report::warnings(hardest), "note") + frames_figure(recording);
  if (recording.frames.size() > 1)
    html += element("h2", "Frame " + std::to_string(recording.hardest) + ", which presses hardest");
  html += frame_html(hardest) + readings_figure(hardest);
  html += colophon("The scene, the files, the command", scene_html(scene), page.files,
                   Made{.by = by, .files = {"result.json"}});
  page.html = page_html(scene.file + " - tactile-net", html);
  return page;
}

}  // namespace tactile_net::pages
