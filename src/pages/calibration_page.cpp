#include "tactile_net/pages/calibration_page.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <variant>

#include "pages/axis.hpp"
#include "pages/parts.hpp"
#include "pages/pixel_text.hpp"
#include "pages/skin_figures.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/calibration_words.hpp"
#include "tactile_net/scene/calibrated_scene.hpp"

namespace tactile_net::pages {
namespace {

using drawing::Curve;
using drawing::element;
using drawing::Figure;
using drawing::Figures;
using drawing::html_list;
using drawing::html_table;
using drawing::Page;
using drawing::Plot;

/// The readings of one press in one channel, and what the two pads say of them.
Figure press_figure(const lab::SceneCalibration& found, std::size_t p, std::size_t c,
                    const std::string& name, const std::string& words) {
  const PressFit& fit = found.fit;
  const Channel& channel = found.channels[c];
  const double noise = found.log.unloaded.rms[c];
  std::vector<double> y, measured, before, after;
  for (std::size_t j = 0; j < found.sites.size(); ++j) {
    if (found.sites[j].channel != c) continue;
    y.push_back(found.is_skin() ? static_cast<double>(found.sites[j].taxel) : found.sites[j].y);
    measured.push_back(found.log.presses[p].readings[j] - fit.offsets[j]);
    before.push_back(measured.back() - noise * fit.residuals_before(p, j));
    after.push_back(measured.back() - noise * fit.residuals(p, j));
  }
  const PlotAxis along = found.is_skin() ? PlotAxis{"taxel, row after row"}
                                         : axis(found.units(), "position", Dimension::length, {&y});
  const PlotAxis up =
      axis(found.units(), channel.name, dimension_of(traits(channel.quantity).kind), {&measured});
  Plot plot{"Press " + std::to_string(fit.presses[p].number), along.label, up.label, along(y), {}};
  plot.curves.push_back({"nominal", up(before), 2});
  plot.curves.back().dashed = true;
  plot.curves.push_back({"calibrated", up(after), 1});
  plot.curves.push_back({"measured", up(measured), 0, true});
  return {name, "presses", words, std::move(plot)};
}

Figure rms_figure(const lab::SceneCalibration& found) {
  Plot plot{"Residuals of each press", "press", "rms / noise", {}, {}};
  plot.from_zero = true;
  Curve before{"nominal", {}, 2, true}, after{"calibrated", {}, 1, true};
  for (const FittedPress& press : found.fit.presses) {
    plot.x.push_back(static_cast<double>(press.number));
    before.y.push_back(press.rms_before);
    after.y.push_back(press.rms);
  }
  plot.curves = {before, after, {"the noise", std::vector<double>(plot.x.size(), 1.0), 0}};
  return {"residuals", "presses",
          "How far each press' readings are from the model's, in units of the noise: where the "
          "calibration holds, the dots lie on the line.",
          std::move(plot)};
}

Figure profile_figure(const lab::SceneCalibration& found) {
  Plot plot{"Misfit over the depth", "depth / stated depth", "root of its rise", {}, {}};
  for (const ProfilePoint& point : found.fit.profile)
    plot.x.push_back(point.depth / found.fit.at(PadParameter::depth).nominal);
  Curve root{"the log", {}, 1}, straight{"as its sd says", {}, 0};
  root.marks = true;
  straight.dashed = true;
  for (const ProfilePoint& point : found.fit.profile) {
    root.y.push_back(point.root);
    straight.y.push_back(point.z);
  }
  plot.curves = {root, straight};
  return {"profile", "parameters",
          "How the misfit rises when the depth is held elsewhere and all else is fitted again. "
          "Where the two lines agree, the standard deviation tells all.",
          std::move(plot)};
}

/// Every gain with one standard deviation to each side, over what the scene states.
Figure gains_figure(const lab::SceneCalibration& found) {
  const std::vector<FittedValue>& gains = found.fit.gain;
  double low = 1.0, high = 1.0;
  for (const FittedValue& gain : gains) {
    const double sd = std::isfinite(gain.sd) ? gain.sd : 0.0;
    low = std::min(low, gain.value - sd);
    high = std::max(high, gain.value + sd);
  }
  const double room = 0.08 * (high - low) + 1e-3;
  low -= room;
  high += room;
  const double width = 1000.0, height = 320.0, left = 70.0, bottom = 40.0;
  const auto x = [&](double index) {
    return left + (index + 0.5) * (width - left) / static_cast<double>(gains.size());
  };
  const auto y = [&](double gain) { return (height - bottom) * (high - gain) / (high - low); };
  const double prior = gains.empty() ? 0.0 : gains.front().prior_sd;
  std::string svg =
      "<svg viewBox=\"0 0 1000 320\" style=\"height:auto\" role=\"img\" "
      "aria-label=\"gains with their standard deviations\">\n";
  if (std::isfinite(prior)) {
    const double top = std::max(0.0, y(1.0 + prior));
    const double end = std::min(height - bottom, y(1.0 - prior));
    svg += "<rect x=\"" + px(left) + "\" y=\"" + px(top) + "\" width=\"" + px(width - left) +
           "\" height=\"" + px(end - top) + "\" style=\"fill:var(--rule);opacity:.5\"/>\n";
  }
  const double step = high - low > 0.5 ? 0.2 : high - low > 0.2 ? 0.1 : 0.05;
  for (double tick = std::ceil(low / step) * step; tick < high; tick += step)
    svg += "<line x1=\"" + px(left) + "\" x2=\"1000\" y1=\"" + px(y(tick)) + "\" y2=\"" +
           px(y(tick)) + "\" style=\"stroke:var(--rule);stroke-width:1\"/><text x=\"60\" y=\"" +
           px(y(tick) + 7.0) +
           "\" style=\"font:20px system-ui,sans-serif;fill:var(--quiet);text-anchor:end\">" +
           fixed(tick, 2) + "</text>\n";
  for (std::size_t j = 0; j < gains.size(); ++j) {
    const FittedValue& gain = gains[j];
    const bool solid = is_found(found.fit.gain_about_mean[j]);
    const double at = x(static_cast<double>(j));
    if (std::isfinite(gain.sd))
      svg += "<line x1=\"" + px(at) + "\" x2=\"" + px(at) + "\" y1=\"" +
             px(y(gain.value + gain.sd)) + "\" y2=\"" + px(y(gain.value - gain.sd)) +
             "\" style=\"stroke:var(--blue);stroke-width:2.5\"/>";
    svg += "<circle cx=\"" + px(at) + "\" cy=\"" + px(y(gain.value)) +
           "\" r=\"6\" style=\"stroke:var(--blue);stroke-width:2;fill:" +
           (solid ? "var(--blue)" : "var(--paper)") + "\"><title>reading " + std::to_string(j) +
           ": " + drawing::escaped(drawing::typeset(plus_minus(gain.value, gain.sd))) +
           "</title></circle>\n";
  }
  for (std::size_t j = 0; j < gains.size(); j += std::max<std::size_t>(1, gains.size() / 8))
    svg += "<text x=\"" + px(x(static_cast<double>(j))) +
           "\" y=\"310\" style=\"font:20px system-ui,sans-serif;fill:var(--quiet);"
           "text-anchor:middle\">" +
           std::to_string(j) + "</text>\n";
  return {.name = "gains",
          .section = "gains",
          .caption =
              "The gain of every reading over the one that the scene states, and one standard "
              "deviation to each side; the grey band is what the scene states. Hollow: the "
              "presses say no more than that.",
          .plot = {},
          .picture = svg + "</svg>\n",
          .data = "result.json"};
}

std::vector<Figure> figures_of(const lab::SceneCalibration& found) {
  std::vector<std::size_t> order(found.fit.presses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return found.fit.presses[a].rms < found.fit.presses[b].rms;
  });
  std::vector<Figure> figures{gains_figure(found)};
  const std::vector<Channel>& all = found.channels;
  const auto add = [&](std::size_t p, const std::string& name, const std::string& words) {
    for (std::size_t c = 0; c < all.size(); ++c)
      figures.push_back(press_figure(found, p, c, all.size() == 1 ? name : name + '-' + all[c].name,
                                     c == 0 ? words : "The same press."));
  };
  add(order.back(), "worst-press",
      "The press that fits worst: dots were measured, offsets taken away; dashed is what the "
      "nominal scene says of this press, and the line what the calibrated one says, gains "
      "included.");
  if (order.size() > 2)
    add(order[order.size() / 2], "median-press", "The press in the middle of that order.");
  figures.push_back(rms_figure(found));
  if (!found.fit.profile.empty()) figures.push_back(profile_figure(found));
  return figures;
}

std::string correlations(const PressFit& fit) {
  std::vector<std::vector<std::string>> rows{{"correlation"}};
  for (const PadParameter parameter : fit.free) rows.front().emplace_back(name(parameter));
  for (std::size_t a = 0; a < fit.free.size(); ++a) {
    rows.push_back({std::string(name(fit.free[a]))});
    for (std::size_t b = 0; b < fit.free.size(); ++b)
      rows.back().push_back(fixed(fit.correlation(a, b), 2));
  }
  return html_table(rows);
}

}  // namespace

Page calibration_html(const lab::SceneCalibration& found, const std::string& log,
                      const Made& made) {
  const Figures figures(figures_of(found));
  Page page{.files = figures.data()};
  std::string html = heading(found.title(), found.file() + ", " + log,
                             report::calibrated_in_words(found) + "; " +
                                 std::to_string(found.fit.presses.size()) + " presses");
  html += answer_box(report::answers(found));
  const std::vector<std::string> words = report::calibration_in_words(found);
  html += element("p", words.front(), found.fit.verdict == FitVerdict::ok ? "" : "bad");
  html += html_list({words.begin() + 1, words.end()});
  html += element("h2", "What was found");
  html += html_table(report::calibration_cells(found));
  const std::vector<std::string> hidden = report::null_directions_in_words(found);
  if (!hidden.empty()) {
    html += element("h2", "What this log cannot tell");
    html += html_list(hidden);
  }
  html += element("h2", "Gains");
  html += figures.html("gains");
  html += element("h2", "The presses");
  html += figures.html("presses");
  if (!found.next.presses.empty()) {
    html += element("h2", "Presses to do next");
    html += html_table(report::next_press_cells(found));
    html += element("p", report::next_presses_in_words(found));
  }
  html += element("h2", "How the parameters hang together");
  html += correlations(found.fit);
  html += figures.html("parameters");
  html += colophon("The scene, the files, the command",
                   std::visit([](const auto& scene) { return scene_html(scene); }, found.scene),
                   page.files, made);
  page.html = page_html(found.file() + " - tactile-net calibrate", html);
  return page;
}

}  // namespace tactile_net::pages
