/// @file
/// A study of work and precision in words.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/tradeoff/study.hpp"
#include "tactile_net/lab/tradeoff/work_precision.hpp"

namespace tactile_net::report {

/// What a user has to know first, a sentence each: recommendations and where a circuit is faster.
[[nodiscard]] std::vector<std::string> in_words(const lab::Study& study);

/// The circuits of op-amps of 10 MHz, the fastest first: when each settles to 1 %, below which
/// clock a controller that needs this machine's cycles is slower, from which bandwidth on this
/// machine is, and how far parts of 1 % leave it. The headings alone: none was simulated.
[[nodiscard]] std::vector<std::vector<std::string>> circuit_cells(const lab::Study& study);

/// The answer to a demand, with its margins.
[[nodiscard]] std::string answer(const lab::Study& study, const lab::Requirement& requirement);

}  // namespace tactile_net::report
