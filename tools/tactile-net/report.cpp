#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "html.hpp"
#include "network_words.hpp"
#include "plot.hpp"
#include "table.hpp"
#include "text.hpp"

namespace tactile_net::tool {
namespace {

/// One component of every answer, with bands of two standard deviations, under the truth.
void add_component(std::vector<Plot>& plots, const Experiment& experiment,
                   Component MethodResult::*which, const std::string& title,
                   const std::vector<double>& truth) {
  const std::vector<double> y = positions(experiment.scene.sensor);
  Plot tractions{title + " traction: truth and reconstructions", "y", "traction", y, {}};
  Plot errors{
      title + " traction: error of each reconstruction", "y", "reconstruction - truth", y, {}};
  std::size_t colour = 0;
  for (const MethodResult& result : experiment.results) {
    const Component& component = result.*which;
    ++colour;
    if (component.traction.empty()) continue;
    const std::string label(name(result.method));
    Curve curve{label, component.traction, colour};
    std::vector<double> error = component.traction;
    for (std::size_t i = 0; i < error.size(); ++i) error[i] -= truth[i];
    Curve difference{label, std::move(error), colour};
    for (const double deviation : component.deviation) curve.half_width.push_back(2.0 * deviation);
    tractions.curves.push_back(std::move(curve));
    errors.curves.push_back(std::move(difference));
  }
  const bool any = !errors.curves.empty();
  tractions.curves.push_back({"truth", truth, 0, true});  // last: on top
  plots.push_back(std::move(tractions));
  if (any) plots.push_back(std::move(errors));
}

/// What each rule minimises over alpha, each between 0 and 1.
Plot rules_plot(const AlphaSweep& sweep) {
  Plot plot{"Rules for alpha: what each makes least, scaled to 0 ... 1",
            "alpha",
            "criterion",
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
    for (double& value : values) value = (value - low) / (high - low);
    plot.curves.push_back({std::string(name(curve.rule)) + " " + brief(curve.choice.alpha), values,
                           plot.curves.size()});
  }
  return plot;
}

std::vector<Plot> plots_of(const Experiment& experiment) {
  const Scene& scene = experiment.scene;
  const std::vector<double> y = positions(scene.sensor);
  const TractionField& truth = experiment.simulation.truth;
  std::vector<Plot> plots;
  add_component(plots, experiment, &MethodResult::normal, "Normal", truth.normal);
  const bool tangential =
      std::any_of(experiment.results.begin(), experiment.results.end(),
                  [](const MethodResult& result) { return !result.tangential.traction.empty(); });
  if (tangential)
    add_component(plots, experiment, &MethodResult::tangential, "Tangential",
                  truth.tangential.empty() ? std::vector<double>(y.size()) : truth.tangential);
  if (experiment.sweep) plots.push_back(rules_plot(*experiment.sweep));
  auto begin = experiment.simulation.readings.begin();
  for (const Channel& channel : channels(scene.sensor)) {
    const auto end = begin + static_cast<std::ptrdiff_t>(y.size());
    plots.push_back({"Readings: " + channel.name + " at depth " + brief(channel.depth),
                     "y",
                     std::string(name(channel.quantity)),
                     y,
                     {{channel.name, {begin, end}, 0, true}}});
    begin = end;
  }
  return plots;
}

std::string network_section(const Relaxation& relaxation) {
  return element("h2", "The circuit") +
         element("p", "Realisation " + std::string(name(relaxation.realization)) + ": " +
                          std::to_string(relaxation.nodes) + " nodes, " +
                          elements_in_words(relaxation.elements) +
                          ". Its deck is network.cir beside this file: ngspice -b network.cir.") +
         html_list(in_words(relaxation)) +
         (relaxation.failure().empty() ? "" : element("p", relaxation.failure(), "bad"));
}

}  // namespace

Report report_html(const Experiment& experiment) {
  const Scene& scene = experiment.scene;
  Report report;
  std::vector<std::string> pictures;
  try {
    pictures = draw(plots_of(experiment));
  } catch (const std::runtime_error& error) {
    report.missing = std::string("the report has no plots: ") + error.what();
  }

  std::string& html = report.html;
  html += element("h1", scene.title.empty() ? scene.file : scene.title);
  if (!scene.title.empty()) html += element("p", scene.file);

  html += element("h2", "The scene");
  html +=
      element("p", "Sensor: " + sensor_in_words(scene) + ". Material: " + material_in_words(scene) +
                       ". Forward model: " + std::string(name(scene.forward)) + ".");
  if (scene.time) html += element("p", "This is " + time_in_words(scene) + ".");
  const std::vector<std::string> contacts = contacts_in_words(scene);
  html += contacts.empty() ? element("p", "No contact: an unloaded sensor.") : html_list(contacts);
  html += element("p", "Effects simulated: " + effects_in_words(scene, true) +
                           ". Absent, and free of cost: " + effects_in_words(scene, false) + ".");
  for (const std::string& warning : experiment.simulation.warnings)
    html += element("p", warning, "note");

  html += element("h2", "Methods compared");
  html += html_table(comparison_cells(experiment));
  html += element("p", "Force of the contacts: " + brief(experiment.force) + " exact, " +
                           brief(experiment.sampled_force) +
                           " as pitch x sum of the truth at the taxels. Errors are against the "
                           "truth at the taxels; the network's time per "
                           "frame is a whole run of ngspice, not the circuit's settling time.");
  for (const MethodResult& result : experiment.results) {
    const std::string method = std::string(name(result.method)) + ": ";
    if (result.resultant)
      html += element("p", method + resultant_in_words(*result.resultant) +
                               " (one standard deviation; bands in the plots are two).");
    for (const std::string& warning : result.warnings)
      html += element("p", method + warning, "note");
    if (!result.failure.empty()) html += element("p", method + result.failure, "bad");
  }
  if (experiment.sweep) {
    html += element("h2", "The choice of alpha");
    html += element("p", "Every rule on these readings; " + rule_used(scene) + ".");
    html += html_table(rule_cells(*experiment.sweep));
  }
  if (!report.missing.empty()) html += element("p", report.missing, "note");
  for (const std::string& picture : pictures)
    html += "<figure class=\"plot\">" + picture + "</figure>\n";
  if (experiment.relaxation) html += network_section(*experiment.relaxation);
  html = html_page(scene.file + " - tactile-net", html);
  return report;
}

}  // namespace tactile_net::tool
