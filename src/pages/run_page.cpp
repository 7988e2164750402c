#include "tactile_net/pages/run_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
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
using drawing::html_list;
using drawing::html_page;
using drawing::html_table;
using drawing::Page;
using drawing::Plot;
using report::comparison_cells;
using report::contacts_in_words;
using report::effects_in_words;
using report::elements_in_words;
using report::failure_in_words;
using report::in_words;
using report::material_in_words;
using report::remarks_in_words;
using report::resultant_in_words;
using report::rule_cells;
using report::rule_used;
using report::sensor_in_words;
using report::time_in_words;

constexpr std::string_view answer = "answer";
constexpr std::string_view choice = "choice";
constexpr std::string_view readings = "readings";
constexpr std::string_view over_time = "over time";

/// One component of every answer, with bands of two standard deviations, under the truth.
void add_component(std::vector<Figure>& figures, const lab::Experiment& experiment,
                   lab::Component lab::MethodResult::*which, const std::string& file,
                   const std::string& title, const std::vector<double>& truth) {
  const std::vector<double> y = positions(experiment.scene.sensor);
  Plot tractions{title + " traction", "y [unit of the pitch]", "traction [unit of E]", y, {}};
  Plot errors{
      title + " traction: error", "y [unit of the pitch]", "answer - truth [unit of E]", y, {}};
  bool bands = false;
  std::size_t colour = 0;
  for (const lab::MethodResult& result : experiment.results) {
    const lab::Component& component = result.*which;
    ++colour;
    if (component.traction.empty()) continue;
    const std::string label(name(result.method));
    Curve curve{label, component.traction, colour};
    std::vector<double> error = component.traction;
    for (std::size_t i = 0; i < error.size(); ++i) error[i] -= truth[i];
    Curve difference{label, std::move(error), colour};
    for (const double deviation : component.deviation) curve.half_width.push_back(2.0 * deviation);
    bands = bands || !curve.half_width.empty();
    tractions.curves.push_back(std::move(curve));
    errors.curves.push_back(std::move(difference));
  }
  tractions.curves.push_back({"truth", truth, 0, true});  // last: on top
  figures.push_back({file, std::string(answer),
                     "The truth at the taxels (dots) and every method's answer. Where answers are "
                     "equal the thinner line lies on the thicker." +
                         std::string(bands ? " Bands are two standard deviations, of noise and of "
                                             "what alpha smooths away together: look for dots "
                                             "outside them, at a contact's steep edges first."
                                           : ""),
                     std::move(tractions)});
  figures.push_back({file + "-error", std::string(answer),
                     "Each answer minus the truth. Swings at a contact's edge that die away from "
                     "it are smoothing, and a smaller alpha narrows them; a ripple of one size all "
                     "along the array is noise, and a larger alpha lowers it.",
                     std::move(errors)});
}

/// What each rule minimises over alpha, each between 0 and 1.
Figure rules_figure(const AlphaSweep& sweep, std::optional<AlphaRule> used) {
  Plot plot{"What each rule for alpha makes least",
            "alpha [unit of K'K]",
            "criterion, 0 to 1",
            sweep.alphas,
            {},
            true};
  for (const AlphaSweep::Curve& curve : sweep.curves) {
    std::vector<double> values = curve.values;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (!(high > low)) continue;  // without readings a rule has nothing to choose by
    for (double& value : values) value = (value - low) / (high - low);
    Curve drawn{std::string(name(curve.rule)) + " " + brief(curve.choice.alpha), values,
                1 + plot.curves.size()};
    drawn.width = curve.rule == used ? 4.0 : 1.5;
    plot.curves.push_back(std::move(drawn));
  }
  return {"alpha", std::string(choice),
          "Every rule's criterion over alpha, each scaled to run from 0 to 1; a rule chooses where "
          "its own curve is lowest, at the value in the key; the thick one was used. A flat valley "
          "means that other values do as well; valleys far apart mean that the rules disagree.",
          std::move(plot)};
}

/// Force and centre over the scene's time.
void add_course(std::vector<Figure>& figures, const lab::TimeCourse& course, double pitch) {
  const std::string method(name(course.method));
  const auto of = [](const std::vector<Resultant>& resultants, double Resultant::*which) {
    std::vector<double> values;
    for (const Resultant& one : resultants) values.push_back(one.*which);
    return values;
  };
  Plot forces{"Force over time", "time [s]", "force [unit of E x pitch]", course.time, {}};
  forces.curves.push_back({method + ", normal", of(course.found, &Resultant::normal), 1});
  if (course.tangential)
    forces.curves.push_back({method + ", tangential", of(course.found, &Resultant::tangential), 2});
  const std::vector<double> pressed = of(course.truth, &Resultant::normal);
  forces.curves.push_back({"truth, normal", pressed, 0});
  forces.curves.back().dashed = true;
  if (course.tangential) {
    forces.curves.push_back({"truth, tangential", of(course.truth, &Resultant::tangential), 3});
    forces.curves.back().dashed = true;
  }
  figures.push_back({"force-over-time", std::string(over_time),
                     "What presses on the array (dashed) and what " + method +
                         " finds in every frame by itself. Where a line leaves its dashes by more "
                         "than its own ripple, an effect that the method does not know of is at "
                         "work: creep, hysteresis, drift, a filter.",
                     std::move(forces)});

  // A force that is small beside the readings' noise has its centre anywhere.
  const double least = 0.05 * *std::max_element(pressed.begin(), pressed.end());
  const auto centres = [&](const std::vector<Resultant>& resultants) {
    std::vector<double> values;
    for (std::size_t k = 0; k < resultants.size(); ++k)
      values.push_back(pressed[k] > least ? resultants[k].centre().value_or(
                                                std::numeric_limits<double>::quiet_NaN())
                                          : std::numeric_limits<double>::quiet_NaN());
    return values;
  };
  if (!(least > 0.0)) return;
  Plot centre{"Centre of pressure over time", "time [s]", "y [unit of the pitch]", course.time, {}};
  centre.y_at_least = pitch;
  centre.curves.push_back({method, centres(course.found), 1});
  centre.curves.push_back({"truth", centres(course.truth), 0});
  centre.curves.back().dashed = true;
  figures.push_back(
      {"centre-over-time", std::string(over_time),
       "Where the force acts, while it is more than a twentieth of its largest: below "
       "that noise alone decides. Dashed: the truth.",
       std::move(centre)});
}

std::vector<Figure> figures_of(const lab::Experiment& experiment) {
  const Scene& scene = experiment.scene;
  const std::vector<double> y = positions(scene.sensor);
  const TractionField& truth = experiment.frame.truth;
  std::vector<Figure> figures;
  add_component(figures, experiment, &lab::MethodResult::normal, "normal", "Normal", truth.normal);
  const bool tangential = std::any_of(
      experiment.results.begin(), experiment.results.end(),
      [](const lab::MethodResult& result) { return !result.tangential.traction.empty(); });
  if (tangential)
    add_component(figures, experiment, &lab::MethodResult::tangential, "tangential", "Tangential",
                  truth.tangential.empty() ? std::vector<double>(y.size()) : truth.tangential);
  if (experiment.sweep)
    figures.push_back(rules_figure(
        *experiment.sweep,
        scene.reconstruct.alpha ? std::nullopt : std::optional(scene.reconstruct.alpha_rule)));
  if (experiment.course) add_course(figures, *experiment.course, scene.sensor.pitch);
  auto begin = experiment.frame.readings.begin();
  for (const Channel& channel : channels(scene.sensor)) {
    const auto end = begin + static_cast<std::ptrdiff_t>(y.size());
    const std::string quantity(name(channel.quantity));
    figures.push_back(
        {"readings-" + channel.name,
         std::string(readings),
         "What the taxels read: all that the methods are given. Where it has not died away at the "
         "array's ends, a part of the load's trace is missed.",
         {channel.name + " at depth " + brief(channel.depth),
          "y [unit of the pitch]",
          quantity + (quantity.starts_with("strain") ? " [1]" : " [unit of E]"),
          y,
          {{channel.name, {begin, end}, 0, true}}}});
    begin = end;
  }
  return figures;
}

std::string network_section(const lab::Relaxation& relaxation) {
  const std::optional<lab::Disagreement> disagreement = relaxation.disagreement();
  return element("h2", "The circuit") +
         element("p", "Realisation " + std::string(name(relaxation.realization)) + ": " +
                          std::to_string(relaxation.nodes) + " nodes, " +
                          elements_in_words(relaxation.elements) + ".") +
         "<p>Its deck: <a href=\"network.cir\">network.cir</a>, to be run by ngspice -b.</p>\n" +
         html_list(in_words(relaxation)) +
         (disagreement ? element("p", in_words(*disagreement), "bad") : "");
}

}  // namespace

Page report_html(const lab::Experiment& experiment) {
  const Scene& scene = experiment.scene;
  const Figures figures(figures_of(experiment));
  Page report{.missing = figures.missing(), .files = figures.data()};

  std::string& html = report.html;
  html += element("h1", scene.title.empty() ? scene.file : scene.title);
  if (!scene.title.empty()) html += element("p", scene.file);

  html += element("h2", "The scene");
  html +=
      element("p", "Sensor: " + sensor_in_words(scene) + ". Material: " + material_in_words(scene) +
                       ". Forward model: " + std::string(name(scene.forward)) + ".");
  if (scene.time)
    html += element("p", "This is " + time_in_words(scene) + "; --frame takes another.");
  const std::vector<std::string> contacts = contacts_in_words(scene);
  html += contacts.empty() ? element("p", "No contact: an unloaded sensor.") : html_list(contacts);
  html += element("p", "Effects simulated: " + effects_in_words(scene, true) +
                           ". Absent, and free of cost: " + effects_in_words(scene, false) + ".");
  for (const std::string& warning : in_words(experiment.frame))
    html += element("p", warning, "note");

  if (!report.missing.empty()) html += element("p", report.missing, "note");
  html += element("h2", "Methods compared");
  html += html_table(comparison_cells(experiment));
  html += element(
      "p",
      "Force of the contacts: " + report::in_unit(scene, Dimension::force, experiment.frame.force) +
          " exact, " + report::in_unit(scene, Dimension::force, experiment.sampled_force) +
          " as pitch x sum of the truth at the taxels. Errors are against the "
          "truth at the taxels; the network's time per "
          "frame is a whole run of ngspice, not the circuit's settling time.");
  for (const lab::MethodResult& result : experiment.results) {
    const std::string method = std::string(name(result.method)) + ": ";
    if (result.resultant)
      html += element("p", method + resultant_in_words(scene, *result.resultant) +
                               " (one standard deviation; bands in the plots are two).");
    for (const std::string& warning : remarks_in_words(experiment, result))
      html += element("p", method + warning, "note");
    if (const std::string failure = failure_in_words(experiment, result); !failure.empty())
      html += element("p", method + failure, "bad");
  }
  html += figures.html(answer);
  if (const std::string drawn = figures.html(over_time); !drawn.empty())
    html += element("h2", "Over time") + drawn;
  if (experiment.sweep) {
    html += element("h2", "The choice of alpha");
    html += element("p", "Every rule on these readings; " + rule_used(scene) + ".");
    html += html_table(rule_cells(*experiment.sweep));
    html += figures.html(choice);
  }
  if (const std::string drawn = figures.html(readings); !drawn.empty())
    html += element("h2", "The readings") + drawn;
  if (experiment.relaxation) html += network_section(*experiment.relaxation);
  html = html_page(scene.file + " - tactile-net", html);
  return report;
}

}  // namespace tactile_net::pages
