#include "pages/frames_section.hpp"

#include <algorithm>
#include <string_view>

#include "pages/pad_drawing.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/json/frames_json.hpp"
#include "tactile_net/report/words/frame_words.hpp"

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
  return "<section id=\"frames\" hidden>\n" + pictures + drawing::data_html(json) + "</section>\n";
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
constexpr std::string_view bands =
    " Bands are two standard deviations, of noise and of what alpha smooths away together.";

/// Of a skin: what differs between a recording and a frame is known to the script.
std::string skin_pictures(std::size_t frames, bool truth, bool deviations, bool drags,
                          std::string_view data) {
  const std::string tractions = figure_of(
      "tractions", "maps",
      std::string("Seen from outside: colours are the pressure, mean of each cell") +
          (drags ? ", arrows the drag" : "") +
          "; dots are the taxels, crosses dead ones, and the line runs around the cells that "
          "touch, "
          "over which forces are summed. The pointer tells what is under it; a click keeps a cell, "
          "and a second one lets it go.",
      data);
  const std::string sections = figure_of(
      "sections", truth ? "maps" : "stack",
      "Two lines through the cell that presses hardest, or through the one that was clicked." +
          std::string(deviations ? bands : "") + (truth ? " Dashed: true." : ""),
      data);
  std::string html = player(frames);
  html +=
      truth ? tractions + sections : "<div class=\"two top\">" + tractions + sections + "</div>\n";
  if (truth || deviations)
    html += figure_of("errors", truth ? "maps" : "maps small",
                      truth ? "How far the pressure may be off and how far it is. A ring of both "
                              "colours around a contact is its edge, smoothed; errors all over the "
                              "skin are noise, and a larger alpha lowers them."
                            : "How far the pressure may be off: most where taxels tell little, "
                              "beyond the last of them and between them.",
                      data);
  return html + figure_of("readings", "maps small",
                          "What the taxels read: all that the answer is made of. Blue is "
                          "compression, orange along +y or +z, purple against it.",
                          "readings.csv");
}

}  // namespace

std::string frames_section(const lab::RecordingOverview& overview) {
  const PadLayout pad = pad_layout(overview.scene);
  const std::string inside = "<image data-part=\"inside\" x=\"0\" y=\"" +
                             std::to_string(pad.surface) + "\" width=\"1000\" height=\"" +
                             std::to_string(pad.thickness) + "\" preserveAspectRatio=\"none\"/>\n";
  const std::string above = "<path class=\"pressure\" data-part=\"pressure\" data-surface=\"" +
                            std::to_string(pad.surface) +
                            "\"/><path class=\"drag\" data-part=\"drag\"/>\n";
  const std::string drag = overview.tangential() ? " and the drag" : "";
  std::string html = player(overview.groups.size()) + "<div class=\"two top\">";
  html += figure_html(
      "", "<div data-view=\"pad\">" + draw_pad(overview.scene, inside, above) + "</div>",
      "The pad in section. On the surface the pressure" + drag +
          "; inside, the stress across the surface that they cause: blue presses, "
          "red pulls.",
      "shown.csv");
  html += figure_html("", place_of("sections", "stack"),
                      "The tractions of this frame along the array." +
                          std::string(overview.peak().bands ? bands : ""),
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
  std::vector<FrameWords> words;
  for (const lab::FrameGroup& group : overview.groups)
    words.push_back(report::frame_words(overview, group));
  const auto start = static_cast<std::size_t>(&overview.peak() - overview.groups.data());
  return section_of(html, report::frames_json(overview)) + table_of(words, start);
}

std::string frames_section(const lab::SkinRecordingAnswer& recording) {
  const bool deviations = std::none_of(recording.shown.begin(), recording.shown.end(),
                                       [](const auto& shown) { return shown.deviations.empty(); });
  const bool drags = recording.shown.front().tractions.size() > recording.grid.count();
  std::string html =
      skin_pictures(recording.shown.size(), false, deviations, drags, "tractions.csv");
  if (recording.shown.size() > 1) html += figure_of("time", "stack", over_time, "result.json");
  std::vector<FrameWords> words;
  std::size_t start = 0;
  for (const auto& shown : recording.shown) {
    if (shown.frame == recording.hardest) start = words.size();
    words.push_back(report::frame_words(recording, shown));
  }
  return section_of(html, report::frames_json(recording)) + table_of(words, start);
}

std::string frames_section(const lab::SkinExperiment& experiment) {
  const auto& answer = experiment.answer;
  const std::vector<double>& tractions = answer ? answer->tractions : experiment.frame.truth;
  return section_of(
      skin_pictures(1, answer && experiment.has_truth(), answer && !answer->deviations.empty(),
                    tractions.size() > experiment.grid.count(),
                    answer ? "tractions.csv" : "readings.csv"),
      report::frames_json(experiment));
}

}  // namespace tactile_net::pages
