/// @file
/// What docs/circuits.md says in numbers: each from a run.
#pragma once

#include <string>

#include "tactile_net/network/realization.hpp"

namespace tactile_net::circuits {

/// The array of the page, under its cylinder; more than thirty taxels lie half as far apart.
[[nodiscard]] NetworkProblem array_problem(std::size_t count, double alpha);

/// A table of one realisation at several alphas: agreement, settling, tolerance.
[[nodiscard]] std::string table(Realization realization, const RealizationOptions& options = {});

/// Every realisation at one alpha: what to choose.
[[nodiscard]] std::string comparison(double alpha);

/// Parts of 1 % with and without a ladder, for more and more taxels.
[[nodiscard]] std::string ladder_tolerances();

/// What second poles and capacitance at its nodes a ladder bears, by the residual amplifiers' gain.
[[nodiscard]] std::string ladder_lags();

/// The cheapest lists of parts for 0.3 % over one, three and five loads.
[[nodiscard]] std::string allocations_table();

/// Errors of N-shaped devices over their voltage.
[[nodiscard]] std::string devices();

/// Op-amps that are sold, with their pins: from circuits/parts.
[[nodiscard]] std::string parts_table();

/// Typical op-amps in three realisations, at two scales.
[[nodiscard]] std::string opamp_classes_table();

/// What steps, noise and wires of programmable arrays do.
[[nodiscard]] std::string arrays_table();

/// Circuits of parts that are off, refined in numbers: bounds, builds, errors by cycle.
[[nodiscard]] std::string refinement_table();

/// How far behind a moving contact they are; lengths taken for mm.
[[nodiscard]] std::string motion_table();

}  // namespace tactile_net::circuits
