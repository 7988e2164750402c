#include "tactile_net/pages/recording_page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "pages/pad_drawing.hpp"
#include "pages/parts.hpp"
#include "pages/recording_script.hpp"
#include "pages/time_picture.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/json/recording_json.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/recording_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::enclosed;
using drawing::escaped;
using drawing::words_html;
using lab::FrameGroup;
using lab::RecordingOverview;
using ValueOf = std::function<double(const FrameGroup&)>;
using report::answers;
using report::distrusted_in_words;
using report::group_clock;
using report::material_in_words;
using report::recording_in_words;
using report::recording_json;
using report::sensor_in_words;
using report::traction_range;
using report::TractionRange;

/// A caption is text, and where the numbers of every picture are known (recording_csv.hpp).
std::string framed(std::string_view picture, std::string_view caption,
                   std::string_view type = "whole-row") {
  return drawing::figure_html("", picture, words_html(caption), "shown.csv", type);
}

/// A figure over time, with the cursor that the slider moves.
std::string figure_over_time(const RecordingOverview& overview, const Range& range,
                             const ScaledUnit& unit, std::string_view label, std::string_view type,
                             const std::string& inside, std::string_view caption) {
  const auto& groups = overview.groups;
  return framed(
      stretched_picture(groups.size(), range, unit, label, "over-time " + std::string(type),
                        inside + "<line class=\"cursor\" x1=\"-1\" x2=\"-1\" y1=\"0\" y2=\"100\"/>",
                        {group_clock(groups.front()), group_clock(groups[groups.size() / 2]),
                         group_clock(groups.back())}),
      caption);
}

/// A value of every group, as a picture's columns ask for it.
ColumnValue column(const RecordingOverview& overview, ValueOf value) {
  return [&overview, value = std::move(value)](std::size_t i) { return value(overview.groups[i]); };
}

/// y over time: the component of every group's frame over the largest that is trusted.
std::string map_of(const RecordingOverview& overview, Traction traction) {
  const double largest = overview.largest(traction);
  if (!(largest > 0.0)) return {};
  return heat_map(overview.groups.size(), surface(overview.scene).count, traction,
                  [&](std::size_t column, std::size_t taxel) {
                    return overview.component(overview.groups[column].tractions, traction)[taxel] /
                           largest;
                  });
}

Range along_the_array(const Scene& scene) {
  const Surface places = surface(scene);
  return {places.centre - places.half_width(), places.centre + places.half_width()};
}

/// The unit of a range's numbers; without [units] no label, since a line of words stands no place.
ScaledUnit unit_of(const Scene& scene, Dimension dimension, const Range& range) {
  if (!scene.units) return {};
  return report::axis_unit(scene, dimension, std::max(range.high, -range.low));
}

std::string heat_maps(const RecordingOverview& overview) {
  const Scene& scene = overview.scene;
  const Range y = along_the_array(scene);
  const ScaledUnit unit = unit_of(scene, Dimension::length, y);
  const auto traction = [&](Traction which) {
    return report::in_unit(scene, Dimension::stress, overview.largest(which));
  };
  const auto centre = column(overview, [&overview, y](const FrameGroup& group) {
    const auto place = group.resultant.centre();
    return place && overview.loaded(group) && *place > y.low && *place < y.high
               ? *place
               : std::numeric_limits<double>::quiet_NaN();
  });
  std::string html = element("h2", "Normal traction, y over time");
  html += figure_over_time(
      overview, y, unit, "Heat map of the normal traction over time", "",
      map_of(overview, Traction::normal) + path_of(overview.groups.size(), y, centre, "centre"),
      "Full blue presses with " + traction(Traction::normal) +
          ", red would pull, nothing is the page's own colour. The line is the "
          "centre of pressure. A click chooses a frame; a stroke along a picture "
          "shows that part of all of them, a double click everything again.");
  if (!overview.tangential()) return html;
  return html + element("h2", "Tangential traction, y over time") +
         figure_over_time(overview, y, unit, "Heat map of the tangential traction over time", "low",
                          map_of(overview, Traction::tangential_y),
                          "Orange drags along +y, purple along -y; full colour at " +
                              traction(Traction::tangential_y) + ".");
}

double double_or_nan(const FrameGroup& group, double NoiseEstimate::*which) {
  return group.bands ? group.bands->noise.*which : std::numeric_limits<double>::quiet_NaN();
}

std::string forces(const RecordingOverview& overview) {
  const auto deviation = [](const FrameGroup& group, bool tangential) {
    if (!group.bands) return 0.0;
    const UncertainResultant& contact = group.bands->resultant;
    return tangential ? contact.tangential.value_or(Uncertain{}).deviation
                      : contact.normal.deviation;
  };
  const auto low = [&](bool tangential) -> ValueOf {
    return [=](const FrameGroup& g) {
      return std::min((tangential ? g.resultant.tangential : g.resultant.normal) -
                          2.0 * deviation(g, tangential),
                      tangential ? g.lowest_tangential : g.lowest_normal);
    };
  };
  const auto high = [&](bool tangential) -> ValueOf {
    return [=](const FrameGroup& g) {
      return std::max((tangential ? g.resultant.tangential : g.resultant.normal) +
                          2.0 * deviation(g, tangential),
                      tangential ? g.highest_tangential : g.highest_normal);
    };
  };
  Range range;
  for (const FrameGroup* group : overview.trusted())
    for (const bool tangential : {false, true}) {
      range.take(low(tangential)(*group));
      range.take(high(tangential)(*group));
    }
  if (range.empty()) range.high = 1.0;
  const std::size_t columns = overview.groups.size();
  std::string inside = level_line(columns, range, 0.0, "zero");
  const auto add = [&](bool tangential, std::string_view type) {
    inside += area_of(columns, range, column(overview, low(tangential)),
                      column(overview, high(tangential)), std::string(type) + "-area");
    inside += path_of(columns, range,
                      column(overview,
                             [tangential](const FrameGroup& g) {
                               return tangential ? g.resultant.tangential : g.resultant.normal;
                             }),
                      type);
  };
  add(false, "normal");
  if (overview.tangential()) add(true, "tangential");
  return "<h2>Force over time: <span class=\"key-normal\">normal</span>" +
         std::string(overview.tangential() ? ", <span class=\"key-tangential\">tangential</span>"
                                           : "") +
         "</h2>\n" +
         figure_over_time(
             overview, range, unit_of(overview.scene, Dimension::force, range),
             "Force over time with bands", "", inside,
             "Bands are two standard deviations, of noise and smoothing together; where a "
             "point stands for several frames, they reach over all of these.");
}

std::string residuals(const RecordingOverview& overview) {
  if (!overview.peak().bands) return {};
  Range range;
  for (const FrameGroup& group : overview.groups)
    range.take(double_or_nan(group, &NoiseEstimate::residual_rms));
  const auto stated = overview.peak().bands->noise.stated_rms;
  if (stated) range.take(1.2 * *stated);
  if (range.empty()) return {};
  std::string inside;
  const std::size_t columns = overview.groups.size();
  if (stated) inside += level_line(columns, range, *stated, "normal");
  inside += path_of(
      columns, range,
      column(overview,
             [](const FrameGroup& g) { return double_or_nan(g, &NoiseEstimate::residual_rms); }),
      "residual");
  return element("h2", "What the tractions leave unexplained") +
         figure_over_time(
             overview, range,
             unit_of(overview.scene, report::residual_dimension(overview.scene), range),
             "Residual over time", "low", inside,
             "Root mean square of a reading's residual" +
                 std::string(stated ? "; the blue line is the noise that the scene states. "
                                      "Above it the pad, the depth or the calibration is "
                                      "not as stated"
                                    : ", which stands for the noise") +
                 ".");
}

/// "border", "ok; misfit": of the answers, and of the readings of the frame shown.
std::string strip_title(const FrameGroup& group) {
  std::string title(name(group.distrust));
  if (group.doubted > 0)
    title += "; " + (group.data && !group.data->consistent() ? report::data_word(*group.data)
                                                             : std::string("readings doubted"));
  return title;
}

/// A strip of every group's verdict: neighbours alike are one piece.
std::string verdicts(const RecordingOverview& overview) {
  const auto& groups = overview.groups;
  std::string inside;
  for (std::size_t i = 0; i < groups.size();) {
    std::size_t end = i + 1;
    const bool trusted = groups[i].distrusted == 0 && groups[i].doubted == 0;
    const std::string why = strip_title(groups[i]);
    while (end < groups.size() && strip_title(groups[end]) == why) ++end;
    inside += "<rect class=\"" + std::string(trusted ? "trusted" : "distrusted") + "\" x=\"" +
              std::to_string(i) + "\" width=\"" + std::to_string(end - i) +
              "\" y=\"0\" height=\"100\"><title>" + escaped(why) + "</title></rect>";
    i = end;
  }
  return element("h2", "Which frames to trust") +
         figure_over_time(overview, {}, {}, "Verdict of every frame", "strip", inside,
                          "Red: at least one frame here is not to be trusted.") +
         drawing::html_list(distrusted_in_words(overview));
}

std::string one_frame(const RecordingOverview& overview) {
  const Scene& scene = overview.scene;
  const PadLayout pad = pad_layout(scene);
  const std::string inside = "<image id=\"inside\" x=\"0\" y=\"" + fixed(pad.surface, 1) +
                             "\" width=\"1000\" height=\"" + fixed(pad.thickness, 1) +
                             "\" preserveAspectRatio=\"none\"/>\n";
  const std::string above = "<path class=\"pressure\" id=\"pressure\" data-surface=\"" +
                            fixed(pad.surface, 1) + "\"/><path class=\"drag\" id=\"drag\"/>\n";
  const TractionRange tractions = traction_range(overview);
  const Range range{tractions.low, tractions.high};
  const std::size_t n = surface(scene).count;
  const std::string lines =
      level_line(n, range, 0.0, "zero") +
      "<path class=\"normal-area\" id=\"normal-band\"/><path class=\"tangential-area\" "
      "id=\"tangential-band\"/><path class=\"normal\" id=\"normal-line\"/><path "
      "class=\"tangential\" id=\"tangential-line\"/>";
  return "<section id=\"live\" hidden>\n<div class=\"two\">" +
         framed(draw_pad(scene, inside, above),
                "The pad in section. On the surface the pressure" +
                    std::string(overview.tangential() ? " and the drag" : "") +
                    "; inside, the stress across the surface that they cause: blue presses, red "
                    "pulls.",
                "") +
         drawing::figure_html(
             "",
             stretched_picture(n, range, unit_of(scene, Dimension::stress, range),
                               "Tractions of the chosen frame", "", lines, ends_of_surface(scene)),
             "<span class=\"key-normal\">Normal</span>" +
                 std::string(overview.tangential()
                                 ? " and <span class=\"key-tangential\">tangential</span>"
                                 : "") +
                 " traction along the array. Bands: two standard deviations.",
             "shown.csv") +
         "</div>\n<input type=\"range\" id=\"frame\" min=\"0\" max=\"" +
         std::to_string(overview.groups.size() - 1) +
         "\" aria-label=\"frame\">\n<p id=\"where\"></p><p id=\"answer\"></p><p id=\"trust\" "
         "class=\"bad\" hidden></p>\n</section>\n<noscript><p class=\"note\">Without JavaScript "
         "single frames are not shown.</p></noscript>\n";
}

}  // namespace

drawing::Page recording_page(const RecordingOverview& overview, const std::string& readings,
                             const std::vector<std::string>& notes, const Made& made) {
  const Scene& scene = overview.scene;
  std::string html = enclosed("h1", escaped(scene.title.empty() ? readings : scene.title));
  html += element("p", recording_in_words(overview), "quiet");
  html += overview.groups.empty() ? enclosed("p", escaped(readings) + " holds no frame.", "bad")
                                  : answer_box(answers(overview));
  html += suspicions(overview.findings, scene) + paragraphs(notes, "note");
  if (!overview.groups.empty())
    html += one_frame(overview) + heat_maps(overview) + forces(overview) + residuals(overview) +
            verdicts(overview);
  html += colophon("The scene, the method, the files",
                   enclosed("p", escaped(scene.file) + ": " +
                                     words_html(sensor_in_words(scene) + "; " +
                                                material_in_words(scene) + ". Readings: ") +
                                     escaped(readings) + "."),
                   {}, made);
  if (!overview.groups.empty())
    html += "<script type=\"application/json\" id=\"data\">" + recording_json(overview) +
            "</script>\n<script>" + std::string(recording_script()) + "</script>\n";
  return {.html = page_html(readings + " - tactile-net", html)};
}

}  // namespace tactile_net::pages
