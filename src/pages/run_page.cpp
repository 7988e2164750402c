#include "tactile_net/pages/run_page.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "pages/alpha_figure.hpp"
#include "pages/axis.hpp"
#include "pages/network_section.hpp"
#include "pages/pad_drawing.hpp"
#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/lab/agreement.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/csv/run_csv.hpp"
#include "tactile_net/report/words/contact_words.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::Curve;
using drawing::element;
using drawing::Figure;
using drawing::Figures;
using drawing::Page;
using drawing::Plot;
using report::answers;
using report::comparison_cells;
using report::failure_in_words;
using report::in_unit;
using report::in_words;
using report::material_in_words;
using report::other_conditions_in_words;
using report::remarks_in_words;
using report::resultant_in_words;
using report::rule_cells;
using report::rule_used;
using report::sensor_in_words;
using report::truth_in_words;

constexpr std::string_view answer_section = "answer";
constexpr std::string_view choice_section = "choice";
constexpr std::string_view readings_section = "readings";
constexpr std::string_view over_time_section = "over time";

/// The methods that found the same, as one label: "tikhonov = closed_form".
std::string label_of(const lab::Experiment& experiment, const lab::Agreement& group) {
  std::vector<std::string> names;
  for (const std::size_t i : group.results) names.emplace_back(name(experiment.results[i].method));
  return join(names, " = ");
}

/// A band of two standard deviations about values.
void add_deviations(Curve& curve, const std::vector<double>& deviations) {
  for (std::size_t i = 0; i < curve.y.size(); ++i) {
    curve.low.push_back(curve.y[i] - 2.0 * deviations[i]);
    curve.high.push_back(curve.y[i] + 2.0 * deviations[i]);
  }
}

std::string intervals_label(const Scene& scene) {
  return percent(scene.interval_level) + " intervals";
}

/// One component of every answer under the truth, equal ones once, with the first's band.
void add_component(std::vector<Figure>& figures, const lab::Experiment& experiment,
                   std::size_t which, const std::string& file, const std::string& title) {
  const Scene& scene = experiment.line();
  const std::vector<double> places = positions(surface(scene));
  const auto component = [&](const std::vector<double>& values) {
    const auto one = lab::component(values, places.size(), which);
    return std::vector<double>(one.begin(), one.end());
  };
  std::vector<double> truth = component(experiment.frame.truth);
  truth.resize(places.size());  // else nothing drags
  const PlotAxis along = axis(scene.units, "y", Dimension::length, {&places});
  std::vector<double> all = truth;
  std::vector<double> apart;
  for (const lab::MethodResult& result : experiment.results) {
    const std::vector<double> tractions = component(result.answer.tractions);
    for (std::size_t i = 0; i < tractions.size(); ++i) {
      all.push_back(tractions[i]);
      apart.push_back(tractions[i] - truth[i]);
    }
  }
  const PlotAxis traction = axis(scene.units, "traction", Dimension::stress, {&all});
  const PlotAxis off = axis(scene.units, "answer - truth", Dimension::stress, {&apart});
  Plot found{title + " traction", along.label, traction.label, along(places), {}};
  Plot error{title + " traction: error", along.label, off.label, along(places), {}};
  std::size_t colour = 0;
  bool band = false, interval = false;
  for (const lab::Agreement& group : lab::agreements(experiment.results)) {
    const lab::FrameAnswer& answer = experiment.results[group.results.front()].answer;
    std::vector<double> difference = component(answer.tractions);
    if (difference.empty()) continue;
    Curve curve{label_of(experiment, group), traction(difference), ++colour};
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= truth[i];
    error.curves.push_back({curve.label, off(std::move(difference)), colour});
    if (!band && answer.has_bands()) {
      band = true;
      interval = !answer.low.empty();
      if (interval) {
        curve.low = traction(component(answer.low));
        curve.high = traction(component(answer.high));
      } else {
        add_deviations(curve, traction(component(answer.deviations)));
      }
    }
    found.curves.push_back(std::move(curve));
  }
  if (band) found.band_label = interval ? intervals_label(scene) : "two deviations";
  found.curves.push_back({"truth", traction(truth), 0, true});  // last: on top
  figures.push_back(
      {file,
       std::string(answer_section),
       "The truth" +
           std::string(scene.reconstruct.surface.basis == SurfaceBasis::taxels ? " at the taxels"
                                                                               : "") +
           " (dots) and the answers; methods that found the same are one line." +
           std::string(interval
                           ? " The band holds the truth as often as its label says, where pad and "
                             "noise are as the scene says: look for dots outside it, at a "
                             "contact's steep edges first."
                       : band ? " The band is two standard deviations, of noise and of what alpha "
                                "smooths away together: look for dots outside it, at a contact's "
                                "steep edges first."
                              : ""),
       std::move(found),
       {},
       {},
       "tall"});
  figures.push_back({file + "-error", std::string(answer_section),
                     "Each answer minus the truth. Swings at a contact's edge that die away from "
                     "it are smoothing, and a smaller alpha narrows them; a ripple of one size all "
                     "along the array is noise, and a larger alpha lowers it.",
                     std::move(error)});
}

/// Every frame's traction as the method finds it: y over time.
Figure map_figure(const Scene& scene, const lab::TimeCourse& course) {
  const std::size_t n = surface(scene).count;
  const std::size_t frames = course.time.size();
  const std::size_t stride = course.tractions.size() / frames;
  const auto at = [&](std::size_t frame, std::size_t taxel) {
    return course.tractions[frame * stride + taxel];
  };
  const std::vector<double> places = positions(surface(scene));
  const PlotAxis along = axis(scene.units, "y", Dimension::length, {&places});
  const PlotAxis traction = axis(scene.units, "traction", Dimension::stress, {&course.tractions});
  Plot plot{"Normal traction", "time [s]", traction.label, course.time, {}};
  std::vector<double> peaks(frames);
  for (std::size_t i = 0; i < n; ++i) {
    Curve row{"y = " + brief(places[i] * along.factor, 6), {}};
    for (std::size_t k = 0; k < frames; ++k) {
      row.y.push_back(at(k, i) * traction.factor);
      if (std::isfinite(at(k, i))) peaks[k] = std::max(peaks[k], std::abs(at(k, i)));
    }
    plot.curves.push_back(std::move(row));
  }
  // The size that all but one frame in twenty stay below: a wild answer must not pale the others.
  const auto most = peaks.begin() + static_cast<std::ptrdiff_t>(frames * 19 / 20);
  std::nth_element(peaks.begin(), most, peaks.end());
  const double largest = *most;
  const Surface grid = surface(scene);
  const double half = grid.half_width();
  if (largest > 0.0)
    plot.map = {.label = along.label,
                .low = (grid.centre - half) * along.factor,
                .high = (grid.centre + half) * along.factor,
                .most = largest * traction.factor};
  return {.name = "traction-over-time",
          .section = std::string(over_time_section),
          .caption = "The normal traction that " + std::string(name(course.method)) +
                     " finds, y over time: full blue presses with " +
                     in_unit(scene, Dimension::stress, largest) + " or more" +
                     ", red would pull, nothing is the page's own colour.",
          .plot = std::move(plot),
          .type = "whole-row"};
}

/// Force and centre over the scene's time.
void add_course(std::vector<Figure>& figures, const Scene& scene, const lab::TimeCourse& course) {
  const std::string method(name(course.method));
  const auto of = [](const std::vector<Resultant>& resultants, double Resultant::*which) {
    std::vector<double> values;
    for (const Resultant& one : resultants) values.push_back(one.*which);
    return values;
  };
  const std::vector<double> found = of(course.found, &Resultant::normal);
  const std::vector<double> pressed = of(course.truth, &Resultant::normal);
  const std::vector<double> found_drag = of(course.found, &Resultant::tangential);
  const std::vector<double> drag = of(course.truth, &Resultant::tangential);
  const PlotAxis force = axis(scene.units, "force", Dimension::force, {&found, &pressed});
  Plot forces{"Force over time", "time [s]", force.label, course.time, {}};
  const auto add_ends = [&](Plot& plot, const PlotAxis& axis,
                            std::optional<CentralInterval> lab::ResultantIntervals::*which) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (course.intervals.empty()) return;
    Curve& curve = plot.curves.back();
    for (std::size_t k = 0; k < course.intervals.size(); ++k) {
      const auto& ends = course.intervals[k].*which;
      const bool drawn = ends && std::isfinite(curve.y[k]);
      curve.low.push_back(drawn ? ends->low * axis.factor : none);
      curve.high.push_back(drawn ? ends->high * axis.factor : none);
    }
    plot.band_label = intervals_label(scene);
  };
  forces.curves.push_back({method + ", normal", force(found), 1});
  add_ends(forces, force, &lab::ResultantIntervals::normal);
  if (course.tangential) {
    forces.curves.push_back({method + ", tangential", force(found_drag), 2});
    add_ends(forces, force, &lab::ResultantIntervals::tangential);
  }
  forces.curves.push_back({"truth, normal", force(pressed), 0});
  forces.curves.back().dashed = true;
  if (course.tangential) {
    forces.curves.push_back({"truth, tangential", force(drag), 3});
    forces.curves.back().dashed = true;
  }
  figures.push_back({"force-over-time", std::string(over_time_section),
                     "What presses on the array (dashed) and what " + method +
                         " finds in every frame by itself. Where a line leaves its dashes by more "
                         "than its own ripple, an effect that the method does not know of is at "
                         "work: creep, hysteresis, drift, a filter.",
                     std::move(forces)});

  // A force that is small beside the readings' noise has its centre anywhere.
  const double least = 0.05 * *std::max_element(pressed.begin(), pressed.end());
  if (!(least > 0.0)) return;
  const auto centres = [&](const std::vector<Resultant>& resultants) {
    std::vector<double> values;
    for (std::size_t k = 0; k < resultants.size(); ++k)
      values.push_back(pressed[k] > least ? resultants[k].centre().value_or(
                                                std::numeric_limits<double>::quiet_NaN())
                                          : std::numeric_limits<double>::quiet_NaN());
    return values;
  };
  const std::vector<double> places = positions(surface(scene));
  const PlotAxis along = axis(scene.units, "y", Dimension::length, {&places});
  Plot centre{"Centre of pressure over time", "time [s]", along.label, course.time, {}};
  centre.y_at_least = scene.sensor.pitch * along.factor;
  centre.curves.push_back({method, along(centres(course.found)), 1});
  add_ends(centre, along, &lab::ResultantIntervals::centre);
  centre.curves.push_back({"truth", along(centres(course.truth)), 0});
  centre.curves.back().dashed = true;
  figures.push_back(
      {"centre-over-time", std::string(over_time_section),
       "Where the force acts, while it is more than a twentieth of its largest: below "
       "that noise alone decides. Dashed: the truth.",
       std::move(centre)});
}

/// What the taxels read, channel by channel.
void add_readings(std::vector<Figure>& figures, const lab::Experiment& experiment) {
  const Scene& scene = experiment.line();
  const std::vector<double> all = positions(scene.sensor);
  const PlotAxis along = axis(scene.units, "y", Dimension::length, {&all});
  const std::vector<Site> where = sites(scene.sensor);
  for (const Channel& channel : channels(scene.sensor)) {
    std::vector<double> places;
    std::vector<double> values;
    for (std::size_t i = channel.first; i < channel.first + channel.count; ++i) {
      places.push_back(where[i].y);
      values.push_back(experiment.frame.readings[i]);
    }
    const std::string quantity(name(channel.quantity));
    const bool strain = quantity.starts_with("strain");
    const PlotAxis reading =
        axis(scene.units, quantity, strain ? Dimension::none : Dimension::stress, {&values});
    figures.push_back({"readings-" + channel.name,
                       std::string(readings_section),
                       "What the taxels read: all that the methods are given. Where it has not "
                       "died away at the array's ends, a part of the load's trace is missed.",
                       {channel.name + " at depth " + report::depths_in_words(scene, channel),
                        along.label,
                        reading.label + (strain ? " [1]" : ""),
                        along(places),
                        {{channel.name, reading(values), 0, true}}}});
  }
}

std::vector<Figure> figures_of(const lab::Experiment& experiment) {
  const Scene& scene = experiment.line();
  const std::size_t places = experiment.places();
  const auto truth = [&](std::size_t which) {
    const auto one = lab::component(experiment.frame.truth, places, which);
    return std::vector<double>(one.begin(), one.end());
  };
  const bool drags = experiment.frame.truth.size() > places;
  std::vector<Figure> figures = {
      pad_figure(scene, {truth(0), truth(1)},
                 drags ? "the contacts' pressure and drag" : "the contacts' pressure",
                 answer_section, "truth.csv")};
  add_component(figures, experiment, 0, "normal", "Normal");
  if (std::any_of(experiment.results.begin(), experiment.results.end(),
                  [](const lab::MethodResult& result) { return result.errors.size() > 1; }))
    add_component(figures, experiment, 1, "tangential", "Tangential");
  if (experiment.sweep)
    figures.push_back(alpha_figure(*experiment.sweep, experiment.rule(), choice_section));
  if (experiment.course) {
    figures.push_back(map_figure(scene, *experiment.course));
    add_course(figures, scene, *experiment.course);
  }
  add_readings(figures, experiment);
  return figures;
}

std::string methods_section(const lab::Experiment& experiment) {
  const Scene& scene = experiment.line();
  std::string html =
      element("h2", "Methods compared") + verdict_table(comparison_cells(experiment));
  if (const std::string others = other_conditions_in_words(experiment); !others.empty())
    html += element("p", "Condition of other matrices: " + others + ".");
  html += element(
      "p", "Force of the contacts: " + in_unit(scene, Dimension::force, experiment.frame.force) +
               " exact, " + in_unit(scene, Dimension::force, experiment.sampled_force) +
               " as pitch x sum of " + truth_in_words(scene) + ". Errors are against " +
               truth_in_words(scene) +
               "; the network's time per "
               "frame is a whole run of ngspice, not the circuit's settling time.");
  for (const lab::MethodResult& result : experiment.results) {
    const std::string method = std::string(name(result.method)) + ": ";
    if (const auto& found = result.answer.bands) {
      html += element("p", method + resultant_in_words(scene, found->resultant) +
                               (found->resultant.normal.interval
                                    ? "."
                                    : " (one standard deviation; bands in the plots are two)."));
      if (const auto rows = report::patch_cells(scene.units, found->patches, {},
                                                report::true_contacts(experiment.scene));
          !rows.empty())
        html += element("p", method + "each contact by itself:") + drawing::html_table(rows);
    }
    html += remarks_html(remarks_in_words(experiment, result), method);
  }
  return html;
}

/// A section, where it has a figure.
std::string titled(const Figures& figures, const std::string& title, std::string_view section) {
  const std::string drawn = figures.html(section);
  return drawn.empty() ? drawn : element("h2", title) + drawn;
}

}  // namespace

Page report_html(const lab::Experiment& experiment, const Made& made) {
  const Scene& scene = experiment.line();
  const Figures figures(figures_of(experiment));
  Page page{.files = figures.data()};

  std::string html =
      heading(scene.title, scene.file, sensor_in_words(scene) + "; " + material_in_words(scene));
  html += answer_box(answers(experiment));
  for (const lab::MethodResult& result : experiment.results)
    if (const std::string failure = failure_in_words(experiment, result); !failure.empty())
      html += element("p", std::string(name(result.method)) + ": " + failure, "bad");
  html += paragraphs(in_words(experiment.frame), "note");
  html += figures.html(answer_section);
  html += methods_section(experiment);
  html += titled(figures, "Over time", over_time_section);
  if (experiment.sweep) {
    html += element("h2", "The choice of alpha");
    html += element("p", "Every rule on these readings; " + rule_used(experiment) + ".");
    html += verdict_table(rule_cells(*experiment.sweep)) + figures.html(choice_section);
  }
  html += titled(figures, "The readings", readings_section);
  if (experiment.relaxation) html += network_section(*experiment.relaxation);
  html += colophon("The scene, the files, the command", scene_html(scene), page.files, made);
  page.html = page_html(scene.file + " - tactile-net", html);
  return page;
}

Page run_page(const lab::Experiment& experiment, const std::string& by) {
  if (experiment.of_skin()) return skin_run_page(experiment, by);
  drawing::Files files = report::run_files(experiment);
  Made made{.by = by, .files = {"result.json"}};
  for (const auto& [name, content] : files) made.files.push_back(name);
  Page page = report_html(experiment, made);
  std::move(files.begin(), files.end(), std::back_inserter(page.files));
  return page;
}

}  // namespace tactile_net::pages
