/// @file
/// A list of parts as sentences and tables, and as a file to order from.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tactile_net/lab/parts_list.hpp"

namespace tactile_net::report {

/// Candidates: realisation, op-amps, resistors of each class, price, what draws say.
[[nodiscard]] std::vector<std::vector<std::string>> cells(const lab::PartsList& list);

/// What to order and why, with where the better parts are.
[[nodiscard]] std::string in_words(const lab::PartsList& list);

/// ohm, tolerance, quantity and designators of the chosen circuit's resistors, one value a row, and
/// its op-amps. @pre  there is a choice
[[nodiscard]] std::string order_csv(const lab::PartsList& list);

/// The bill of materials as assemblers take it, one part a row: Comment (its value), Designator and
/// Footprint as on the board, MPN (empty: yours to fill in), Tolerance, Element (its name in the
/// deck), the other one of its pair, and a note where it takes more power than its size carries.
/// @pre  there is a choice
[[nodiscard]] std::string bill_csv(const lab::PartsList& list);

/// The board of the chosen circuit, as KiCad reads it. @pre  there is a choice
[[nodiscard]] std::string board_text(const lab::PartsList& list);

/// Where a machine places each of its parts, `write_positions`. @pre  there is a choice
[[nodiscard]] std::string positions_csv(const lab::PartsList& list);

/// Its schematic, the root's file first: name and text of each. @pre  there is a choice
[[nodiscard]] std::vector<std::pair<std::string, std::string>> schematic_texts(
    const lab::PartsList& list);

/// The project that the board is opened with: KiCad's design rules for it.
[[nodiscard]] std::string project_text();

}  // namespace tactile_net::report
