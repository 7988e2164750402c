/// @file
/// A circuit's numbers as sentences, for the terminal and the report alike.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/lab/relaxation.hpp"

namespace tactile_net::report {

/// "3321 resistors (539 negative), 81 sources"; kinds that are absent are left out.
[[nodiscard]] std::string elements_in_words(const ElementCounts& elements);

/// One fact a line: stability and theorem, poles, settling, tolerance margin, parts, voltages.
[[nodiscard]] std::vector<std::string> in_words(const Certificate& certificate);

/// What draws of components did.
[[nodiscard]] std::vector<std::string> in_words(const ToleranceOptions& options,
                                                const ToleranceResult& result);

/// What the simulator found, beside what the certificate says.
[[nodiscard]] std::vector<std::string> in_words(const lab::Relaxation& relaxation);

/// Candidates of a recommendation: realisation, op-amps, median, 95 %, yield.
[[nodiscard]] std::vector<std::vector<std::string>> cells(
    const lab::Recommendation& recommendation);

}  // namespace tactile_net::report
