/// @file
/// A sweep in words: how far it is, and what came of it.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/sweep/summary.hpp"
#include "tactile_net/sweep/sweep.hpp"

namespace tactile_net::report {

/// "120 of 2000 points, 6 %, about 40 s left", as much of it as is known.
[[nodiscard]] std::string in_words(const sweep::Progress& progress);

/// "1.2 s", "40 s", "12 min", "3 h": of what is left.
[[nodiscard]] std::string time_left(double seconds);

/// "sensor.depth [mm]"; without a unit the key alone.
[[nodiscard]] std::string axis_in_words(const sweep::Table& table, std::size_t axis);

/// "sensor.depth = 1.5 mm"
[[nodiscard]] std::string value_in_words(const sweep::Table& table, std::size_t axis,
                                         const std::string& value);

/// A row for each method, below a header: how many rows, and what of them.
[[nodiscard]] std::vector<std::vector<std::string>> method_cells(const sweep::Table& table);

/// The same for each value of an axis, of one method.
[[nodiscard]] std::vector<std::vector<std::string>> value_cells(const sweep::Table& table,
                                                                const std::string& method,
                                                                std::size_t axis);

/// "3 rows: sensor.depth must be > 0", the most frequent first, ten at most.
[[nodiscard]] std::vector<std::string> failures_in_words(const sweep::Table& table);

/// "no point has an answer; the first, sensor.depth = -1 mm: sensor.depth must be > 0". Empty: one
/// has.
[[nodiscard]] std::string nothing_found_in_words(const sweep::Table& table);

}  // namespace tactile_net::report
