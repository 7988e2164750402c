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
[[nodiscard]] std::string in_words(const lab::PartsList& list);

/// ohm, tolerance, quantity and references of the chosen circuit's resistors, one value a row.
/// @pre  there is a choice
[[nodiscard]] std::string order_csv(const lab::PartsList& list);

/// The bill of materials: one resistor a row, with the other one of its pair, if it has one, and
/// how many there are of its value and tolerance. @pre  there is a choice
[[nodiscard]] std::string bill_csv(const lab::PartsList& list);

/// The board of the chosen circuit, as KiCad reads it. @pre  there is a choice
[[nodiscard]] std::string board_text(const lab::PartsList& list);

}  // namespace tactile_net::report
