/// @file
/// A refinement as sentences and tables.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/lab/circuit_refinement.hpp"
#include "tactile_net/lab/simulated_refinement.hpp"

namespace tactile_net::report {

/// What is proven, or what to do where nothing is.
[[nodiscard]] std::string verdict_in_words(const lab::CircuitRefinement& one);

/// The verdict, what bounds and builds say, the test of the board by itself, and what it pays for.
[[nodiscard]] std::vector<std::string> in_words(const lab::CircuitRefinement& one);

/// Errors after each cycle: median, 95 of 100, worst, conspiring errors.
[[nodiscard]] std::vector<std::vector<std::string>> cycle_cells(const lab::CircuitRefinement& one);

/// Ways to an answer: error, price, time, multiplications.
[[nodiscard]] std::vector<std::vector<std::string>> way_cells(const lab::CircuitRefinement& one);

/// Whether the simulator does as the numbers, and what it was asked.
[[nodiscard]] std::vector<std::string> in_words(const lab::SimulatedRefinement& one);

/// Errors after each cycle, in numbers and in the simulator.
[[nodiscard]] std::vector<std::vector<std::string>> cycle_cells(
    const lab::SimulatedRefinement& one);

}  // namespace tactile_net::report
