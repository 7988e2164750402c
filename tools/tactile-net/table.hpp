/// @file
/// Results as text for a terminal.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "experiment.hpp"

namespace tactile_net::tool {

/// Header and rows of the comparison of methods, as cells: shared by the terminal and the report.
[[nodiscard]] std::vector<std::vector<std::string>> comparison_cells(const Experiment& experiment);

/// "3321 resistors (539 negative), 0 op-amps, 81 sources"
[[nodiscard]] std::string elements_in_words(const ElementCounts& elements);

void print_experiment(std::ostream& out, const Experiment& experiment);
void print_relaxation(std::ostream& out, const Relaxation& relaxation);

}  // namespace tactile_net::tool
