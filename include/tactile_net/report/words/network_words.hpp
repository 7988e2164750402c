/// @file
/// A circuit's results as sentences, for the terminal and the report alike.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/certification.hpp"
#include "tactile_net/lab/recommendation.hpp"
#include "tactile_net/lab/relaxation.hpp"

namespace tactile_net::report {

/// "3321 resistors (539 negative), 81 sources"; kinds that are absent are left out.
[[nodiscard]] std::string elements_in_words(const ElementCounts& elements);

/// "least_squares with a ladder": a realisation in the form that it has.
[[nodiscard]] std::string circuit_in_words(Realization realization, bool ladder);

/// Why its stability is not known. @pre  it is `not_modelled`
[[nodiscard]] std::string unknown_in_words(const Certificate& certificate);

/// "not with its op-amps": of a candidate that is not stable with what the scene states.
[[nodiscard]] std::string stability_with_opamps_in_words(Stability stability);

/// "a second pole": which of the theorem's conditions is not met; empty if it holds.
[[nodiscard]] std::string condition_in_words(const Theorem& theorem);

/// What it says, and whether it speaks of this circuit.
[[nodiscard]] std::string in_words(const Theorem& theorem);

/// A rule that is broken, and what to write in the scene to mend it.
[[nodiscard]] std::string in_words(const CircuitRemark& remark);
[[nodiscard]] std::string in_words(const lab::RelaxationRemark& remark);
[[nodiscard]] std::string in_words(const lab::Disagreement& disagreement);

/// Every remark on a relaxation, its certificate's first.
[[nodiscard]] std::vector<std::string> warnings_of(const lab::Relaxation& relaxation);

/// One fact a line: stability and theorem, poles, settling, tolerance margin, parts, voltages.
[[nodiscard]] std::vector<std::string> in_words(const Certificate& certificate);

/// What makes a build differ from the exact network: "parts within 1 %".
[[nodiscard]] std::string kinds_of_errors(const ToleranceOptions& options);

/// How many random draws of component values stayed stable, and how far they moved the answer; one
/// fact a line.
[[nodiscard]] std::vector<std::string> in_words(const ToleranceOptions& options,
                                                const ToleranceResult& result);

/// What the simulator found, beside what the certificate says.
[[nodiscard]] std::vector<std::string> in_words(const lab::Relaxation& relaxation);

/// Candidates of a recommendation: realisation, op-amps, median, 95 %, yield.
[[nodiscard]] std::vector<std::vector<std::string>> cells(
    const lab::Recommendation& recommendation);

/// Which realisation to build, and why.
[[nodiscard]] std::string in_words(const lab::Recommendation& recommendation);

/// What the draws say, and where the certificate's poles contradict it. @pre  there are draws
[[nodiscard]] std::vector<std::string> tolerance_in_words(const lab::Certification& certification);

}  // namespace tactile_net::report
