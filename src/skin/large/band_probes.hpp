/// @file
/// Where the deviations of a large skin are solved for, to say how far estimates of them are off.
/// Private.
#pragma once

#include <cstddef>
#include <vector>

#include "tactile_net/skin/large/tikhonov.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// Tractions so far apart that they hardly err together: a solve with signs at all of them tells
/// the variance of each, but for what its sign's random neighbours add.
struct BandProbe {
  std::vector<std::size_t> tractions;
};

/// From end to end of the skin, in the middle between those, and at dead taxels or beside them;
/// components in turn.
[[nodiscard]] std::vector<BandProbe> band_probes(const LinearProblem& problem);

/// Deviations of the probe's tractions per unit of noise, by two solves with P; by one where the
/// prior's alpha is the solver's.
[[nodiscard]] std::vector<double> probed_deviations(LargeSkinTikhonov& solver, double prior_alpha,
                                                    const BandProbe& probe);

}  // namespace tactile_net
