#include "pages/frames_section.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "pages/pad_drawing.hpp"
#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/words/frame_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::escaped;
using drawing::figure_html;
using report::FrameWords;

/// Where web/frames.js draws that view.
std::string place_of(std::string_view view, std::string_view type) {
  return "<div class=\"" + std::string(type) + "\" data-view=\"" + std::string(view) + "\"></div>";
}

std::string figure_of(std::string_view view, std::string_view type, std::string_view caption,
                      std::string_view data) {
  return figure_html("", place_of(view, type), drawing::words_html(caption), data, "skin");
}

/// The slider, and what is said of the frame that it chooses.
std::string player(std::size_t frames) {
  return "<div class=\"player\"><input type=\"range\" data-view=\"slider\" min=\"0\" max=\"" +
         std::to_string(frames - 1) +
         "\" aria-label=\"frame\"><p data-view=\"where\"></p><p data-view=\"answer\"></p>"
         "<p data-view=\"trust\" class=\"bad\" hidden></p></div>\n";
}

/// Hidden until there is a script, which alone can fill it.
std::string section_of(const std::string& pictures, const std::string& json) {
  return "<section id=\"frames\" class=\"frames\" hidden>\n" + pictures + drawing::data_html(json) +
         "</section>\n";
}

/// Frames in words, evenly thinned out, the one at `start` among them: for who has no script, and
/// for who reads.
std::string table_of(const std::vector<FrameWords>& all, std::size_t start) {
  constexpr std::size_t most_rows = 60;
  if (all.size() < 2) return {};
  const std::size_t step = (all.size() + most_rows - 1) / most_rows;
  std::vector<std::vector<std::string>> rows = {{"frame", "answer", "not to be trusted"}};
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i % step == start % step)
      rows.push_back({all[i].place, all[i].answer, all[i].trust.empty() ? "-" : all[i].trust});
  return "<details>" +
         element("summary", step == 1 ? "Every frame in words"
                                      : "Every " + std::to_string(step) + "th frame in words") +
         drawing::html_table(rows,
                             [](std::size_t, const std::string& text) {
                               return escaped(text);  // as it is typeset already
                             }) +
         "</details>\n";
}

constexpr std::string_view over_time =
    "One mark for all pictures: a click in one of them chooses the frame, a stroke along it shows "
    "that part of the time in all, a double click everything again.";
/// What the bands of a frame's tractions are; empty: there are none.
std::string_view bands(const lab::FrameAnswer& answer) {
  if (!answer.low.empty())
    return " Bands are intervals: as often as their label says the truth lies inside, where pad "
           "and "
           "noise are as the scene says.";
  return answer.has_bands() ? " Bands are two standard deviations, of noise and of what alpha "
                              "smooths away together."
                            : "";
}

/// A table that the script fills with the contacts of the frame shown.
std::string contacts_place(const lab::RecordingOverview& overview) {
  if (std::all_of(overview.groups.begin(), overview.groups.end(),
                  [&](const lab::FrameGroup& group) { return overview.contacts(group).empty(); }))
    return {};
  // On paper the contacts of a curved skin, of which more is told, have no room for their columns.
  const bool many = !overview.is_line() && overview.skin().sensor.curved;
  return std::string(many ? "<div class=\"wide many\">" : "<div class=\"wide\">") +
         "<table data-view=\"contacts\"><thead><tr></tr></thead><tbody></tbody>"
         "</table></div>\n" +
         element("p",
                 "The contacts of this frame. A contact keeps its number from frame to frame, as "
                 "long as it covers some of the cells that it covered before.",
                 "quiet");
}

constexpr const char* laid_flat =
    "The map is the surface laid flat about the middle of its taxels: of a ball areas are true, "
    "and "
    "lengths the more stretched the farther out they lie. ";

/// The surface of a curved skin, which web/sides.js draws; empty: it is flat.
std::string sides_figure(const SkinScene& scene, std::string_view data) {
  if (!scene.sensor.curved) return {};
  return figure_of(
      "sides", "maps",
      "The surface from three sides, along the sensor's axes and to one scale. Colours are the "
      "pressure, as on the map; cells that face away are faint, and hidden behind those before "
      "them. Dots are the surface above the taxels, crosses above dead ones; the line runs around "
      "the cells that touch. The arrow is the force on the skin, from the surface above the centre "
      "of pressure: where it lies along the line of sight it is a ring, with a cross if it points "
      "away from who looks and a dot if towards.",
      data);
}

/// Of a skin: what differs between a recording and a frame is known to the script.
/// @param banded  an answer with the bands that all have; null: some have none
std::string skin_pictures(const SkinScene& scene, bool truth, const lab::FrameAnswer* banded,
                          bool drags, std::string_view data) {
  const bool deviations = banded != nullptr;
  const bool two = truth || deviations;
  const bool curved = scene.sensor.curved != nullptr;
  const std::string tractions = figure_of(
      "tractions", "maps",
      std::string(curved ? laid_flat : "") +
          std::string("Seen from outside: colours are the pressure, mean of each cell") +
          (drags ? ", arrows the drag" : "") +
          "; dots are the taxels, crosses dead ones, and the line runs around the cells that "
          "touch, over which forces are summed." +
          (deviations && !truth ? " The pressure may be off most where taxels tell little: beyond "
                                  "the last of them and between them."
                                : "") +
          " The pointer tells what is under it; a click keeps a cell, and a second one lets it go.",
      data);
  const std::string sections = figure_of(
      "sections", two ? "maps" : "stack",
      "Two lines through the cell that presses hardest, or through the one that was clicked." +
          std::string(deviations ? bands(*banded) : "") + (truth ? " Dashed: true." : ""),
      data);
  std::string html = sides_figure(scene, data);
  html +=
      two ? tractions + sections : "<div class=\"two top\">" + tractions + sections + "</div>\n";
  if (truth)
    html += figure_of("errors", "maps",
                      "How far the pressure may be off and how far it is. A ring of both colours "
                      "around a contact is its edge, smoothed; errors all over the skin are noise, "
                      "and a larger alpha lowers them.",
                      data);
  return html + figure_of("readings", "maps small",
                          "What the taxels read: all that the answer is made of. Blue is "
                          "compression, orange along +y or +z, purple against it.",
                          "readings.csv");
}

std::string skin_pictures(const lab::RecordingOverview& overview) {
  const std::vector<lab::FrameGroup>& groups = overview.groups;
  const bool deviations = std::none_of(groups.begin(), groups.end(), [](const auto& group) {
    return group.answer.deviations.empty();
  });
  std::string html =
      player(groups.size()) + contacts_place(overview) +
      skin_pictures(overview.skin(), false, deviations ? &groups.front().answer : nullptr,
                    overview.tangential(), "tractions.csv");
  if (groups.size() > 1) html += figure_of("time", "stack", over_time, "result.json");
  return html;
}

std::string line_pictures(const lab::RecordingOverview& overview) {
  const std::string drag = overview.tangential() ? " and the drag" : "";
  std::string html = player(overview.groups.size()) + contacts_place(overview);
  html += "<div class=\"two top\">";
  html += figure_html("", view_of_pad(draw_pad(overview.line(), true)),
                      "The pad in section. On the surface the pressure" + drag +
                          "; inside, the stress across the surface that they cause: blue presses, "
                          "red pulls.",
                      "shown.csv");
  html += figure_html("", place_of("sections", "stack"),
                      "The tractions of this frame along the array." +
                          std::string(bands(overview.peak().answer)),
                      "shown.csv") +
          "</div>\n";
  html += figure_of("readings", "maps",
                    "What the taxels read in this frame: all that the answer is made of. The "
                    "recording has these numbers; the file beside the page has what was found.",
                    "shown.csv");
  if (overview.groups.size() > 1)
    html += figure_of("time", "stack",
                      std::string(over_time) +
                          " Where a point stands for several frames, its band reaches over all of "
                          "them. In maps of y over time blue presses and red would pull, orange "
                          "drags along +y and purple against it.",
                      "shown.csv");
  return html;
}

}  // namespace

std::string frames_section(const lab::RecordingOverview& overview) {
  std::vector<FrameWords> words;
  for (const lab::FrameGroup& group : overview.groups)
    words.push_back(report::frame_words(overview, group));
  const auto start = static_cast<std::size_t>(&overview.peak() - overview.groups.data());
  return section_of(overview.is_line() ? line_pictures(overview) : skin_pictures(overview),
                    report::frames_json(overview)) +
         table_of(words, start);
}

std::string frames_section(const lab::Experiment& experiment) {
  const lab::MethodResult& result = experiment.results.front();
  const bool answer = result.has_answer();
  const std::vector<double>& tractions = answer ? result.answer.tractions : experiment.frame.truth;
  return section_of(player(1) + skin_pictures(experiment.skin(), answer && experiment.has_truth(),
                                              result.answer.has_bands() ? &result.answer : nullptr,
                                              tractions.size() > experiment.grid.count(),
                                              answer ? "tractions.csv" : "readings.csv"),
                    report::frames_json(experiment));
}

std::string view_of_pad(const std::string& svg) {
  return "<div data-view=\"pad\">" + svg + "</div>";
}

std::string drawn_load(const std::string& views, const report::ShownLoad& load) {
  return "<div class=\"frames\">" + views + drawing::data_html(report::frames_json(load)) +
         "</div>\n";
}

std::string skin_load(const SkinScene& scene, const SurfaceGrid& grid,
                      std::span<const double> tractions, const std::string& title) {
  const SkinWrench wrench = resultant(tractions, grid);
  const std::span<const double> normal = tractions.first(grid.count());
  const auto hardest = std::max_element(normal.begin(), normal.end());
  const auto cell = static_cast<std::size_t>(hardest - normal.begin());
  const auto said = [&](Dimension dimension, double value) {
    return report::in_unit(scene.units, dimension, value);
  };
  std::string words = "Force " + said(Dimension::point_force, wrench.force[0]);
  if (tractions.size() > grid.count())
    words += ", drag " + said(Dimension::point_force, std::hypot(wrench.force[1], wrench.force[2]));
  words += "; hardest at y = " + said(Dimension::length, grid.y(cell / grid.columns)) +
           ", z = " + said(Dimension::length, grid.z(cell % grid.columns)) + ": " +
           said(Dimension::stress, *hardest) + ".";
  return element("p", words) +
         drawn_load("<div class=\"two top\">" + place_of("tractions", "maps") +
                        place_of("sections", "stack") + "</div>",
                    {.grid = grid,
                     .units = scene.units,
                     .tractions = tractions,
                     .title = title,
                     .sites = sites(scene.sensor),
                     .dead = scene.dead_taxels});
}

}  // namespace tactile_net::pages
