#include "tactile_net/pages/calibration_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <variant>

#include "pages/axis.hpp"
#include "pages/parts.hpp"
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
  std::vector<double> y;
  std::vector<double> measured;
  std::vector<double> before;
  std::vector<double> after;
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
  Curve before{"nominal", {}, 2, true};
  Curve after{"calibrated", {}, 1, true};
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
  Curve root{"the log", {}, 1};
  Curve straight{"as its sd says", {}, 0};
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
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> nothing(gains.size(), none);
  Curve told{
      .label = "found", .y = nothing, .colour = 1, .dots = true, .low = nothing, .high = nothing};
  Curve untold = told;
  untold.label = "the presses say no more than the scene";
  untold.colour = 2;
  double low = 1.0;
  double high = 1.0;
  Plot plot{"", "reading", "gain", {}, {}};
  for (std::size_t j = 0; j < gains.size(); ++j) {
    Curve& curve = is_found(found.fit.gain_about_mean[j]) ? told : untold;
    const double sd = std::isfinite(gains[j].sd) ? gains[j].sd : 0.0;
    plot.x.push_back(static_cast<double>(j));
    curve.y[j] = gains[j].value;
    low = std::min(low, curve.low[j] = gains[j].value - sd);
    high = std::max(high, curve.high[j] = gains[j].value + sd);
  }
  const double prior = gains.empty() ? none : gains.front().prior_sd;
  Curve stated{.label = "as the scene states", .y = std::vector<double>(gains.size(), 1.0)};
  stated.dashed = true;
  if (std::isfinite(prior)) {
    stated.label += ": 1 +- " + brief(prior);
    // A band far wider than the gains' range would leave them a line.
    if (prior < 2.0 * (high - low)) {
      stated.low.assign(gains.size(), 1.0 - prior);
      stated.high.assign(gains.size(), 1.0 + prior);
    }
  }
  plot.curves = {std::move(stated), std::move(told), std::move(untold)};
  plot.band_label = "one standard deviation";
  plot.wide = true;
  return {"gains", "gains", "The gain of every reading over the one that the scene states.",
          std::move(plot)};
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
