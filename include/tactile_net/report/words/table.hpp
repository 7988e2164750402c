/// @file
/// Results as text for a terminal.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/decks/deck_file.hpp"
#include "tactile_net/lab/certification.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/simulated_refinement.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net::report {

/// Rows in columns that line up.
void print_cells(std::ostream& out, const std::vector<std::vector<std::string>>& rows);

/// Header and rows of the comparison of a line's methods, as cells: shared by the terminal and the
/// report.
/// Its column "condition" is that of one matrix, tikhonov's.
[[nodiscard]] std::vector<std::vector<std::string>> comparison_cells(
    const lab::Experiment& experiment);

/// Condition numbers that are of other matrices, by method, each with its matrix; may be empty.
[[nodiscard]] std::string other_conditions_in_words(const lab::Experiment& experiment);

/// What is to be said of one method's answer, the circuit's own warnings first.
[[nodiscard]] Sentences remarks_in_words(const lab::Experiment& experiment,
                                         const lab::MethodResult& result);

/// Why a method has no answer that holds; empty if it has.
[[nodiscard]] std::string failure_in_words(const lab::Experiment& experiment,
                                           const lab::MethodResult& result);

/// Every rule's alpha and verdict, as cells.
[[nodiscard]] std::vector<std::vector<std::string>> rule_cells(const AlphaSweep& sweep);

/// "rgcv was used", "the scene gives 1e-4".
[[nodiscard]] std::string rule_used(const lab::Experiment& experiment);

/// "normal force 1.02 +- 0.003, centre 0.1 +- 0.01": one standard deviation.
[[nodiscard]] std::string resultant_in_words(const Scene& scene,
                                             const UncertainResultant& resultant);

/// Of a line or a skin.
void print_experiment(std::ostream& out, const lab::Experiment& experiment);
void print_relaxation(std::ostream& out, const lab::Relaxation& relaxation);

void print_refinement(std::ostream& out, const lab::SimulatedRefinement& refinement);
void print_certificate(std::ostream& out, const lab::Certification& certification);
/// With the five nodes that are furthest off, if the difference is more than is allowed.
void print_deck_answer(std::ostream& out, const std::string& file, const decks::DeckAnswer& answer);

}  // namespace tactile_net::report
