#include "report.hpp"

#include <stdexcept>

#include "plot.hpp"
#include "table.hpp"
#include "text.hpp"

namespace tactile_net::tool {
namespace {

constexpr std::string_view style = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 62rem; margin: 2rem auto;
       padding: 0 1rem; }
h1 { font-size: 1.6rem; margin-bottom: 0; } h2 { font-size: 1.15rem; margin-top: 2rem; }
table { border-collapse: collapse; } .wide { overflow-x: auto; }
th, td { text-align: left; padding: .25rem .8rem .25rem 0; border-bottom: 1px solid #ddd;
         white-space: nowrap; font-variant-numeric: tabular-nums; }
.note { color: #7a4b00; background: #fff6e5; padding: .4rem .8rem; border-left: 4px solid #e69f00; }
.bad { color: #8a1c00; background: #fdecea; padding: .4rem .8rem; border-left: 4px solid #d55e00; }
svg { max-width: 100%; height: auto; } footer { color: #666; margin-top: 3rem; font-size: .9rem; }
)";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string element(std::string_view tag, std::string_view content, std::string_view type = {}) {
  std::string out = "<" + std::string(tag);
  if (!type.empty()) out += " class=\"" + std::string(type) + "\"";
  return out + ">" + escaped(content) + "</" + std::string(tag) + ">\n";
}

std::string list(const std::vector<std::string>& items) {
  std::string out = "<ul>\n";
  for (const std::string& item : items) out += element("li", item);
  return out + "</ul>\n";
}

std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::string out = "<div class=\"wide\"><table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out += "<tr>";
    for (const std::string& cell : rows[i]) out += element(i == 0 ? "th" : "td", cell);
    out += "</tr>\n";
  }
  return out + "</table></div>\n";
}

std::vector<Plot> plots_of(const Experiment& experiment) {
  const Scene& scene = experiment.scene;
  const std::vector<double> y = positions(scene.sensor);
  const std::vector<double>& truth = experiment.simulation.truth.normal;
  Plot tractions{"Normal traction: truth and reconstructions", "y", "traction", y, {}};
  Plot errors{"Error of each reconstruction", "y", "reconstruction - truth", y, {}};
  for (const MethodResult& result : experiment.results) {
    if (result.normal.empty()) continue;
    const std::string label(name(result.method));
    const std::size_t colour = tractions.curves.size() + 1;
    tractions.curves.push_back({label, result.normal, colour});
    std::vector<double> error = result.normal;
    for (std::size_t i = 0; i < error.size(); ++i) error[i] -= truth[i];
    errors.curves.push_back({label, error, colour});
  }

  tractions.curves.push_back({"truth", truth, 0, true});  // last: on top
  std::vector<Plot> plots = {tractions};
  if (!errors.curves.empty()) plots.push_back(errors);
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
         element("p",
                 "ngspice's node voltages differ from the direct solve of P f = b by " +
                     brief(relaxation.difference) + " in the 2-norm (rounding explains up to " +
                     brief(relaxation.limit) +
                     "). Smallest eigenvalue of P: " + brief(relaxation.smallest_eigenvalue) +
                     (relaxation.stable
                          ? ": positive, so the circuit settles with any capacitance at its nodes."
                          : ": not positive, so the circuit would not settle.") +
                     " ngspice took " + duration(relaxation.ngspice_seconds) + ".",
                 relaxation.agrees() && relaxation.stable ? "" : "bad");
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
  html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n";
  html += element("title", scene.file + " - tactile-net") + "<style>" + std::string(style) +
          "</style></head>\n<body>\n";
  html += element("h1", scene.title.empty() ? scene.file : scene.title);
  if (!scene.title.empty()) html += element("p", scene.file);

  html += element("h2", "The scene");
  html +=
      element("p", "Sensor: " + sensor_in_words(scene) + ". Material: " + material_in_words(scene) +
                       ". Forward model: " + std::string(name(scene.forward)) + ".");
  const std::vector<std::string> contacts = contacts_in_words(scene);
  html += contacts.empty() ? element("p", "No contact: an unloaded sensor.") : list(contacts);
  html += element("p", "Effects simulated: " + effects_in_words(scene, true) +
                           ". Absent, and free of cost: " + effects_in_words(scene, false) + ".");
  for (const std::string& warning : experiment.simulation.warnings)
    html += element("p", warning, "note");

  html += element("h2", "Methods compared");
  html += table(comparison_cells(experiment));
  html += element("p", "Force of the contacts: " + brief(experiment.force) + " exact, " +
                           brief(experiment.sampled_force) +
                           " as pitch x sum of the truth at the taxels. Errors are against the "
                           "truth at the taxels; the network's time per "
                           "frame is a whole run of ngspice, not the circuit's settling time.");
  for (const MethodResult& result : experiment.results) {
    const std::string method = std::string(name(result.method)) + ": ";
    for (const std::string& warning : result.warnings)
      html += element("p", method + warning, "note");
    if (!result.failure.empty()) html += element("p", method + result.failure, "bad");
  }
  if (!report.missing.empty()) html += element("p", report.missing, "note");
  for (const std::string& picture : pictures) html += "<figure>" + picture + "</figure>\n";
  if (experiment.relaxation) html += network_section(*experiment.relaxation);
  html += element("footer", "Written by tactile-net " TACTILE_NET_VERSION
                            ". Lengths, forces and tractions are in the scene's units.");
  html += "</body>\n</html>\n";
  return report;
}

}  // namespace tactile_net::tool
