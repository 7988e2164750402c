/// @file
/// Results as text for a terminal.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "experiment.hpp"

namespace tactile_net::tool {

/// Rows in columns that line up.
void print_cells(std::ostream& out, const std::vector<std::vector<std::string>>& rows);

/// Header and rows of the comparison of methods, as cells: shared by the terminal and the report.
[[nodiscard]] std::vector<std::vector<std::string>> comparison_cells(const Experiment& experiment);

/// Every rule's alpha and verdict, as cells.
[[nodiscard]] std::vector<std::vector<std::string>> rule_cells(const AlphaSweep& sweep);

/// "rgcv was used", "the scene gives 1e-4".
[[nodiscard]] std::string rule_used(const Scene& scene);

/// "normal force 1.02 +- 0.003, centre 0.1 +- 0.01": one standard deviation.
[[nodiscard]] std::string resultant_in_words(const UncertainResultant& resultant);

/// "3321 resistors (539 negative), 0 op-amps, 81 sources"
[[nodiscard]] std::string elements_in_words(const ElementCounts& elements);

void print_experiment(std::ostream& out, const Experiment& experiment);
void print_relaxation(std::ostream& out, const Relaxation& relaxation);

}  // namespace tactile_net::tool
