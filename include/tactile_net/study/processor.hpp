/// @file
/// The processor that arithmetic is timed on.
#pragma once

#include <string>

#include "tactile_net/lab/stopwatch.hpp"

namespace tactile_net::study {

/// Cycles a second [Hz], by a chain of additions; 0 where it cannot be measured.
[[nodiscard]] double processor_clock(const lab::Clock& clock);

/// As Linux names it; empty where it does not.
[[nodiscard]] std::string processor_name();

}  // namespace tactile_net::study
