/// @file
/// A vendor's macromodel against the certificate, in words.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/lab/macromodel_comparison.hpp"

namespace tactile_net::report {

/// The verdict first, a sentence each.
[[nodiscard]] std::vector<std::string> in_words(const lab::MacromodelComparison& comparison);

void print_macromodel(std::ostream& out, const lab::MacromodelComparison& comparison);

}  // namespace tactile_net::report
