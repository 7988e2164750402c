/// @file
/// What docs/circuits.md says in numbers: each from a run.
#pragma once

#include <string>

#include "tactile_net/network/realization.hpp"

namespace tactile_net::circuits {

/// A table of one realisation at several alphas: agreement, settling, tolerance.
[[nodiscard]] std::string table(Realization realization, bool inverters = false);

/// Every realisation at one alpha: what to choose.
[[nodiscard]] std::string comparison(double alpha);

/// Errors of N-shaped devices over their voltage.
[[nodiscard]] std::string devices();

/// Typical op-amps in three realisations, at two scales.
[[nodiscard]] std::string opamp_classes_table();

/// How far behind a moving contact they are; lengths taken for mm.
[[nodiscard]] std::string motion_table();

}  // namespace tactile_net::circuits
