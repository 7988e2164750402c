#include "table.hpp"

#include <algorithm>
#include <iomanip>
#include <ostream>

#include "text.hpp"

namespace tactile_net::tool {
namespace {

void print_cells(std::ostream& out, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += row[i] + std::string(widths[i] - row[i].size() + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << '\n';
  }
}

}  // namespace

std::vector<std::vector<std::string>> comparison_cells(const Experiment& experiment) {
  std::vector<std::vector<std::string>> rows = {{"method", "alpha", "mean |error|", "relative L2",
                                                 "force", "condition", "set-up", "per frame",
                                                 "verdict"}};
  for (const MethodResult& result : experiment.results) {
    const std::string method(name(result.method));
    if (result.normal.empty()) {
      rows.push_back({method, "-", "-", "-", "-", "-", "-", "-", result.verdict});
      continue;
    }
    rows.push_back({method, result.alpha ? exact(*result.alpha) : "-", brief(result.mean_abs),
                    brief(result.relative_l2), brief(result.force), brief(result.condition),
                    duration(result.setup_seconds), duration(result.frame_seconds),
                    result.verdict});
  }
  return rows;
}

std::string elements_in_words(const ElementCounts& elements) {
  return std::to_string(elements.resistors) + " resistors (" +
         std::to_string(elements.negative_resistors) + " negative), " +
         std::to_string(elements.opamps) + " op-amps, " + std::to_string(elements.sources) +
         " sources";
}

void print_relaxation(std::ostream& out, const Relaxation& relaxation) {
  out << "network: " << name(relaxation.realization) << ", " << relaxation.nodes << " nodes, "
      << elements_in_words(relaxation.elements) << '\n'
      << "  ngspice against the direct solve of P f = b: " << brief(relaxation.difference)
      << (!relaxation.agrees()    ? " (DIFFERS"
          : relaxation.resolved() ? " (agrees"
                                  : " (NOT RESOLVED")
      << "; rounding explains " << brief(relaxation.limit) << ")\n"
      << "  smallest eigenvalue of P: " << brief(relaxation.smallest_eigenvalue)
      << (relaxation.stable ? " > 0: settles with capacitance at its nodes\n"
                            : ": NOT positive definite, would not settle\n")
      << "  ngspice took " << duration(relaxation.ngspice_seconds) << '\n';
}

void print_experiment(std::ostream& out, const Experiment& experiment) {
  const Scene& scene = experiment.scene;
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n")
      << (scene.title.empty() ? "" : "  ") << sensor_in_words(scene) << "; "
      << material_in_words(scene) << '\n';
  for (const std::string& contact : contacts_in_words(scene)) out << "  " << contact << '\n';
  out << "  forward model " << name(scene.forward)
      << "; effects simulated: " << effects_in_words(scene, true)
      << "; absent: " << effects_in_words(scene, false) << "\n";
  for (const std::string& warning : experiment.simulation.warnings)
    out << "  warning: " << warning << '\n';
  out << '\n';
  print_cells(out, comparison_cells(experiment));
  out << "force of the contacts: " << brief(experiment.force) << " exact, "
      << brief(experiment.sampled_force) << " as pitch x sum of the truth at the taxels\n";
  for (const MethodResult& result : experiment.results) {
    for (const std::string& warning : result.warnings)
      out << name(result.method) << ": warning: " << warning << '\n';
    if (!result.failure.empty())
      out << name(result.method) << ": FAILED: " << result.failure << '\n';
  }
  if (experiment.relaxation) {
    out << '\n';
    print_relaxation(out, *experiment.relaxation);
  }
}

}  // namespace tactile_net::tool
