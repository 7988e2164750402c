/// @file
/// A board on the bench, in words.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/lab/board_bench.hpp"

namespace tactile_net::report {

/// "Rk3_4p is open", "Rk1_2p and Rt0_3n are swapped".
[[nodiscard]] std::string in_words(const lab::BoardBench& bench, const BoardFault& fault);

/// The verdict first, a sentence each.
[[nodiscard]] std::vector<std::string> in_words(const lab::BoardBench& bench);

/// The candidates, the first row the header; empty: there are none.
[[nodiscard]] std::vector<std::vector<std::string>> candidate_cells(const lab::BoardBench& bench);

/// The parts that the responses tell most of, beside the fault: their errors.
[[nodiscard]] std::vector<std::vector<std::string>> part_cells(const lab::BoardBench& bench);

/// The digital correction as CSV: outputs by outputs, with their names.
[[nodiscard]] std::string correction_csv(const lab::BoardBench& bench);

void print_bench(std::ostream& out, const lab::BoardBench& bench);

}  // namespace tactile_net::report
