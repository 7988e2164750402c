#include "tactile_net/pages/skin_page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include "pages/network_section.hpp"
#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "pages/time_picture.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/recording_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::figure_html;

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
    return report::clock_in_words(recording.frames[i].time, i);
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
  const SurfaceGrid& grid = recording.grid;
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
        "Frame " + std::to_string(one.frame) +
        (std::isnan(frame.time) ? "" : ", t = " + report::clock_in_words(frame.time, one.frame)) +
        ": " +
        report::in_unit(units, Dimension::point_force, frame.wrench.normal.value,
                        frame.wrench.normal.deviation) +
        (frame.verdict == lab::Verdict::ok ? "" : ", " + std::string(name(frame.verdict))) +
        (frame.data.consistent() ? "" : ", data " + report::data_word(frame.data, recording.scene));
    html += std::string("<div class=\"frame\"") + (i == first ? ">" : " hidden>") +
            traction_map(recording.scene, grid, one.tractions, one.cells, scales, title) + "</div>";
  }
  const std::string last = std::to_string(recording.shown.size() - 1);
  return figure_html(
      "frames",
      "<div class=\"maps\"><div>" + html + "<input type=\"range\" id=\"frame\" min=\"0\" max=\"" +
          last + "\" value=\"" + std::to_string(first) + "\" aria-label=\"Frame\">" +
          traction_bar(recording.scene, scales) + "</div><div>" + course_pictures(recording) +
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
  html += remarks_html(report::remarks_in_words(experiment));
  if (experiment.answer) {
    html += frame_html(experiment);
  } else {
    html += element("p", experiment.refusal, "bad");
  }
  html += readings_figure(experiment);
  if (const auto& network = experiment.network) {
    html += network->relaxation
                ? network_section(*network->relaxation)
                : element("h2", "The circuit") + element("p", network->refusal, "bad");
    if (network->relaxation) html += element("p", report::network_errors_in_words(*network));
  }
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
  drawing::Page page;
  if (recording.answer) page.files = report::run_files(hardest);
  std::string html =
      heading(scene.title, scene.file + ", " + readings,
              std::to_string(recording.frames.size()) +
                  (recording.frames.size() == 1 ? " frame; " : " frames; ") +
                  report::sensor_in_words(scene) + "; " + report::material_in_words(scene));
  html += answer_box(report::answers(recording));
  html += suspicions(recording.findings, scene);
  html += remarks_html(report::remarks_in_words(hardest)) + frames_figure(recording);
  if (recording.answer && recording.frames.size() > 1)
    html += element("h2", "Frame " + std::to_string(recording.hardest) + ", which presses hardest");
  if (recording.answer) html += frame_html(hardest) + readings_figure(hardest);
  html += colophon("The scene, the files, the command", scene_html(scene), page.files,
                   Made{.by = by, .files = {"result.json"}});
  page.html = page_html(scene.file + " - tactile-net", html);
  return page;
}

}  // namespace tactile_net::pages
