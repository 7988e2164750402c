#include "tactile_net/pages/recording_page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "pages/recording_script.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/drawing/png.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/pages/pad_drawing.hpp"
#include "tactile_net/report/json/recording_json.hpp"
#include "tactile_net/report/words/recording_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::Colour;
using drawing::element;
using drawing::escaped;
using lab::FrameGroup;
using lab::RecordingOverview;
using ValueOf = std::function<double(const FrameGroup&)>;
using report::Answer;
using report::answers;
using report::distrusted_in_words;
using report::group_clock;
using report::material_in_words;
using report::recording_in_words;
using report::recording_json;
using report::sensor_in_words;
using report::traction_range;
using report::TractionRange;

constexpr std::string_view style = R"(
:root { --blue: #2166ac; --orange: #b25806; --red: #c0392b; --card: #f6f8fa; }
@media screen and (prefers-color-scheme: dark) {
  :root { --blue: #6baed6; --orange: #f1a340; --red: #ff7b6b; --card: #1d2226; }
}
.answers { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 15.5rem), 1fr)); gap: .8rem; margin: 1.2rem 0; }
.answers div { background: var(--card); border: 1px solid var(--rule); border-radius: 10px; padding: .7rem 1rem; }
.answers b { display: block; font-size: 1.35rem; font-variant-numeric: tabular-nums; }
.answers span, .quiet { color: var(--quiet); font-size: .95rem; } .answers .doubtful b { color: var(--red); }
.two { display: grid; grid-template-columns: 1.25fr 1fr; gap: 1.6rem; align-items: end; }
@media (max-width: 48rem) { .two { grid-template-columns: 1fr; } }
.two figure, .time { max-width: none; } .two svg { width: 100%; height: auto; display: block; overflow: visible; }
.two text { font: 28px system-ui, sans-serif; fill: var(--quiet); }
.picture { display: grid; grid-template-columns: 4.2rem 1fr; }
.picture > svg { width: 100%; height: 12rem; overflow: hidden; display: block; }
.two .picture > svg { height: 15rem; } .picture > svg.low { height: 7rem; } .picture > svg.strip { height: .8rem; }
.over-time { cursor: crosshair; touch-action: pan-y; }
.ticks { display: flex; flex-direction: column; justify-content: space-between; text-align: right; padding-right: .5rem; }
.ticks { position: relative; } .ticks .zero { position: absolute; right: .5rem; transform: translateY(-50%); }
.ticks, .clock { white-space: nowrap; font-size: .8rem; color: var(--quiet); font-variant-numeric: tabular-nums; line-height: 1; }
.clock { display: flex; justify-content: space-between; padding: .3rem 0 0 4.2rem; }
.picture path, .picture line { vector-effect: non-scaling-stroke; fill: none; stroke-width: 2; }
.normal { stroke: var(--blue); } .tangential { stroke: var(--orange); } .residual { stroke: var(--ink); }
.picture path.normal-area { fill: var(--blue); opacity: .2; stroke: none; }
.picture path.tangential-area { fill: var(--orange); opacity: .2; stroke: none; }
.picture line.zero { stroke: var(--rule); stroke-width: 1; }
.picture line.cursor { stroke: var(--ink); stroke-width: 1.2; stroke-dasharray: 4 3; }
.picture path.centre { stroke: var(--ink); stroke-width: 1.5; opacity: .75; }
.trusted { fill: #2e7d4f; opacity: .35; } .distrusted { fill: var(--red); }
#pressure { fill: var(--blue); opacity: .8; } #drag { stroke: var(--orange); stroke-width: 2.5; fill: none; }
.key-normal { color: var(--blue); font-weight: 600; } .key-tangential { color: var(--orange); font-weight: 600; }
input[type=range] { width: 100%; accent-color: var(--blue); margin: 1rem 0 0; }
#answer { font-variant-numeric: tabular-nums; margin: .2rem 0; } #where { font-weight: 600; margin: .2rem 0; }
details { border-top: 1px solid var(--rule); margin-top: 2rem; padding-top: .6rem; } summary { cursor: pointer; font-weight: 600; }
@media print { #live { display: none; } .picture > svg { height: 4cm; } }
)";

/// A caption, and where the numbers of every picture are (recording_csv.hpp).
std::string described(std::string_view caption) {
  return "<figcaption>" + escaped(caption) + " <a href=\"shown.csv\">Numbers</a></figcaption>";
}

/// The least and the greatest of what a picture shows.
struct Range {
  double low = 0.0;
  double high = 0.0;

  void take(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool empty() const { return !(high > low); }
  /// From 0 at the top to 100 at the bottom.
  [[nodiscard]] double at(double value) const { return 100.0 * (high - value) / (high - low); }
};

std::string ticks(const Range& range) {
  if (range.empty()) return "<div></div>";
  std::string text = "<div class=\"ticks\"><span>" + brief(range.high) + "</span>";
  if (range.low < 0.0 && -range.low > 0.15 * range.high && range.high > -0.15 * range.low)
    text += "<span class=\"zero\" style=\"top:" + fixed(range.at(0.0), 1) + "%\">0</span>";
  const bool from_zero = std::abs(range.low) < 0.02 * range.high;
  return text + "<span>" + brief(from_zero ? 0.0 : range.low) + "</span></div>";
}

std::string clock(const RecordingOverview& overview) {
  const auto& groups = overview.groups;
  std::string text = "<div class=\"clock\">";
  for (const FrameGroup* group : {&groups.front(), &groups[groups.size() / 2], &groups.back()})
    text += element("span", group_clock(*group));
  return text + "</div>";
}

std::string time_picture(const RecordingOverview& overview, const Range& range,
                         std::string_view label, std::string_view type, const std::string& inside,
                         std::string_view caption) {
  const std::string width = std::to_string(overview.groups.size());
  return "<figure class=\"time\"><div class=\"picture\">" + ticks(range) +
         "<svg class=\"over-time " + std::string(type) + "\" viewBox=\"0 0 " + width +
         " 100\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"" + escaped(label) + "\">" +
         inside + "<line class=\"cursor\" x1=\"-1\" x2=\"-1\" y1=\"0\" y2=\"100\"/></svg></div>" +
         clock(overview) + described(caption) + "</figure>\n";
}

/// A path over the groups; a gap where the value is not finite.
std::string path_of(const RecordingOverview& overview, const Range& range, const ValueOf& value,
                    std::string_view type) {
  std::string d;
  bool pen = false;
  for (std::size_t i = 0; i < overview.groups.size(); ++i) {
    const double y = range.at(value(overview.groups[i]));
    if (std::isfinite(y))
      d += (pen ? "L" : "M") + fixed(static_cast<double>(i) + 0.5, 1) + ' ' + fixed(y, 2);
    pen = std::isfinite(y);
  }
  return "<path class=\"" + std::string(type) + "\" d=\"" + d + "\"/>";
}

std::string area_of(const RecordingOverview& overview, const Range& range, const ValueOf& low,
                    const ValueOf& high, std::string_view type) {
  std::string d;
  const auto add = [&](std::size_t i, const ValueOf& edge) {
    d += (d.empty() ? "M" : "L") + fixed(static_cast<double>(i) + 0.5, 1) + ' ' +
         fixed(range.at(edge(overview.groups[i])), 2);
  };
  for (std::size_t i = 0; i < overview.groups.size(); ++i) add(i, high);
  for (std::size_t i = overview.groups.size(); i-- > 0;) add(i, low);
  return "<path class=\"" + std::string(type) + "\" d=\"" + d + "Z\"/>";
}

std::string level_line(const RecordingOverview& overview, const Range& range, double level,
                       std::string_view type) {
  const std::string y = fixed(range.at(level), 2);
  return "<line class=\"" + std::string(type) + "\" x1=\"0\" x2=\"" +
         std::to_string(overview.groups.size()) + "\" y1=\"" + y + "\" y2=\"" + y + "\"/>";
}

/// y over time: the component of every group's frame, largest y on top.
std::string heat_map(const RecordingOverview& overview, Traction component, double largest) {
  const std::size_t n = overview.scene.sensor.count;
  std::vector<std::uint8_t> pixels(n * overview.groups.size());
  for (std::size_t column = 0; column < overview.groups.size(); ++column) {
    const auto values = overview.component(overview.groups[column].tractions, component);
    for (std::size_t i = 0; i < n; ++i)
      pixels[(n - 1 - i) * overview.groups.size() + column] =
          drawing::diverging_index(values[i] / largest);
  }
  const auto palette = component == Traction::normal
                           ? drawing::diverging(Colour{192, 57, 43}, Colour{33, 102, 172})
                           : drawing::diverging(Colour{118, 42, 131}, Colour{200, 98, 6});
  return "<image x=\"0\" y=\"0\" width=\"" + std::to_string(overview.groups.size()) +
         "\" height=\"100\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," +
         drawing::base64(drawing::png(overview.groups.size(), n, pixels, palette)) + "\"/>";
}

Range along_the_array(const Scene& scene) {
  const double half = 0.5 * scene.sensor.pitch * static_cast<double>(scene.sensor.count);
  return {-half, half};
}

std::string heat_maps(const RecordingOverview& overview) {
  const Range y = along_the_array(overview.scene);
  const double most = overview.largest(Traction::normal);
  const auto centre = [&](const FrameGroup& group) {
    const auto place = group.resultant.centre();
    return place && overview.loaded(group) && std::abs(*place) < y.high
               ? *place
               : std::numeric_limits<double>::quiet_NaN();
  };
  std::string html = element("h2", "Normal traction, y over time");
  html += time_picture(overview, y, "Heat map of the normal traction over time", "",
                       (most > 0.0 ? heat_map(overview, Traction::normal, most) : "") +
                           path_of(overview, y, centre, "centre"),
                       "Full blue presses with " + brief(most) +
                           ", red would pull, nothing is the page's own colour. The line is the "
                           "centre of pressure. A click chooses a frame; a stroke along a picture "
                           "shows that part of all of them, a double click everything again.");
  if (!overview.tangential()) return html;
  const double side = overview.largest(Traction::tangential);
  return html + element("h2", "Tangential traction, y over time") +
         time_picture(
             overview, y, "Heat map of the tangential traction over time", "low",
             side > 0.0 ? heat_map(overview, Traction::tangential, side) : "",
             "Orange drags along +y, purple along -y; full colour at " + brief(side) + ".");
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
  std::string inside = level_line(overview, range, 0.0, "zero");
  inside += area_of(overview, range, low(false), high(false), "normal-area");
  inside += path_of(
      overview, range, [](const FrameGroup& g) { return g.resultant.normal; }, "normal");
  if (overview.tangential()) {
    inside += area_of(overview, range, low(true), high(true), "tangential-area");
    inside += path_of(
        overview, range, [](const FrameGroup& g) { return g.resultant.tangential; }, "tangential");
  }
  return "<h2>Force over time: <span class=\"key-normal\">normal</span>" +
         std::string(overview.tangential() ? ", <span class=\"key-tangential\">tangential</span>"
                                           : "") +
         "</h2>\n" +
         time_picture(overview, range, "Force over time with bands", "", inside,
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
  if (stated) inside += level_line(overview, range, *stated, "normal");
  inside += path_of(
      overview, range,
      [](const FrameGroup& g) { return double_or_nan(g, &NoiseEstimate::residual_rms); },
      "residual");
  return element("h2", "What the tractions leave unexplained") +
         time_picture(
             overview, range, "Residual over time", "low", inside,
             "Root mean square of a reading's residual" +
                 std::string(stated ? "; the blue line is the noise that the scene states. "
                                      "Above it the pad, the depth or the calibration is "
                                      "not as stated"
                                    : ", which stands for the noise") +
                 ".");
}

/// A strip of every group's verdict: neighbours alike are one piece.
std::string verdicts(const RecordingOverview& overview) {
  const auto& groups = overview.groups;
  std::string inside;
  for (std::size_t i = 0; i < groups.size();) {
    std::size_t end = i + 1;
    const bool trusted = groups[i].distrusted == 0;
    while (end < groups.size() && (groups[end].distrusted == 0) == trusted &&
           groups[end].distrust == groups[i].distrust)
      ++end;
    inside += "<rect class=\"" + std::string(trusted ? "trusted" : "distrusted") + "\" x=\"" +
              std::to_string(i) + "\" width=\"" + std::to_string(end - i) +
              "\" y=\"0\" height=\"100\"><title>" + escaped(name(groups[i].distrust)) +
              "</title></rect>";
    i = end;
  }
  return element("h2", "Which frames to trust") +
         time_picture(overview, {}, "Verdict of every frame", "strip", inside,
                      "Red: at least one frame here is not to be trusted.") +
         drawing::html_list(distrusted_in_words(overview));
}

std::string one_frame(const RecordingOverview& overview) {
  const Scene& scene = overview.scene;
  const PadFrame pad = pad_frame(scene);
  const std::string inside = "<image id=\"inside\" x=\"0\" y=\"" + fixed(pad.surface, 1) +
                             "\" width=\"1000\" height=\"" + fixed(pad.thickness, 1) +
                             "\" preserveAspectRatio=\"none\"/>\n";
  const std::string above =
      "<path id=\"pressure\" data-surface=\"" + fixed(pad.surface, 1) + "\"/><path id=\"drag\"/>\n";
  const TractionRange tractions = traction_range(overview);
  const Range range{tractions.low, tractions.high};
  const std::string zero = fixed(range.at(0.0), 2);
  const std::string n = std::to_string(scene.sensor.count);
  return "<section id=\"live\" hidden>\n<div class=\"two\"><figure>" +
         draw_pad(scene, inside, above) +
         described("The pad in section. On the surface the pressure" +
                   std::string(overview.tangential() ? " and the drag" : "") +
                   "; inside, the stress across the surface that they cause: blue presses, red "
                   "pulls.") +
         "</figure><figure><div class=\"picture\">" + ticks(range) + "<svg viewBox=\"0 0 " + n +
         " 100\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"Tractions of the chosen "
         "frame\"><line class=\"zero\" x1=\"0\" x2=\"" +
         n + "\" y1=\"" + zero + "\" y2=\"" + zero +
         "\"/><path class=\"normal-area\" id=\"normal-band\"/><path class=\"tangential-area\" "
         "id=\"tangential-band\"/><path class=\"normal\" id=\"normal-line\"/><path "
         "class=\"tangential\" id=\"tangential-line\"/></svg></div><div class=\"clock\"><span>y "
         "= " +
         brief(-0.5 * scene.sensor.pitch * static_cast<double>(scene.sensor.count)) +
         "</span><span>0</span><span>" +
         brief(0.5 * scene.sensor.pitch * static_cast<double>(scene.sensor.count)) +
         "</span></div><figcaption><span class=\"key-normal\">Normal</span>" +
         (overview.tangential() ? " and <span class=\"key-tangential\">tangential</span>" : "") +
         " traction along the array. Bands: two standard deviations. <a "
         "href=\"shown.csv\">Numbers</a></figcaption></figure></div>\n" +
         "<input type=\"range\" id=\"frame\" min=\"0\" max=\"" +
         std::to_string(overview.groups.size() - 1) +
         "\" aria-label=\"frame\">\n<p id=\"where\"></p><p id=\"answer\"></p><p id=\"trust\" "
         "class=\"bad\" hidden></p>\n</section>\n<noscript><p class=\"note\">Without JavaScript "
         "single frames are not shown.</p></noscript>\n";
}

}  // namespace

drawing::Page recording_page(const RecordingOverview& overview, const std::string& readings,
                             const std::vector<std::string>& notes,
                             const std::vector<std::string>& files) {
  const Scene& scene = overview.scene;
  std::string html = element("h1", scene.title.empty() ? readings : scene.title);
  html += element("p", recording_in_words(overview), "quiet");
  if (overview.groups.empty()) {
    html += element("p", readings + " holds no frame.", "bad");
  } else {
    html += "<div class=\"answers\">\n";
    for (const Answer& answer : answers(overview))
      html += std::string("<div") + (answer.doubtful ? " class=\"doubtful\"" : "") + "><b>" +
              escaped(answer.value) + "</b>" + element("span", answer.meaning) + "</div>\n";
    html += "</div>\n";
  }
  for (const std::string& note : notes) html += element("p", note, "note");
  if (!overview.groups.empty()) {
    html += one_frame(overview) + heat_maps(overview) + forces(overview) + residuals(overview) +
            verdicts(overview);
  }
  html += "<details><summary>The scene, the method, the files</summary>\n" +
          element("p", scene.file + ": " + sensor_in_words(scene) + "; " +
                           material_in_words(scene) + ". Readings: " + readings + ".");
  for (const std::string& file : files)
    html += "<p><a href=\"" + escaped(file) + "\">" + escaped(file) + "</a></p>\n";
  html += "</details>\n";
  if (!overview.groups.empty())
    html += "<script type=\"application/json\" id=\"data\">" + recording_json(overview) +
            "</script>\n<script>" + std::string(recording_script()) + "</script>\n";
  return {.html = drawing::html_page(readings + " - tactile-net", html,
                                     std::string(pad_style()) + std::string(style))};
}

}  // namespace tactile_net::pages
