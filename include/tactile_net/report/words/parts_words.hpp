/// @file
/// A list of parts as sentences and tables, and as a file to order from.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/parts_list.hpp"

namespace tactile_net::report {

/// Candidates: realisation, op-amps, resistors of each class, price, what draws say.
[[nodiscard]] std::vector<std::vector<std::string>> cells(const lab::PartsList& list);

/// What to order and why, with where the better parts are.
[[nodiscard]] std::string in_words(const lab::PartsList& list, const lab::SceneCircuit& circuit);

/// ohm, tolerance, quantity and references of the chosen circuit's resistors, one value a row.
/// @pre  there is a choice
[[nodiscard]] std::string order_csv(const lab::PartsList& list, const lab::SceneCircuit& circuit);

}  // namespace tactile_net::report
