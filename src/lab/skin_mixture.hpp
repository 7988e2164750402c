/// @file
/// What a skin's frame amounts to by all that its readings leave possible. Private.
#pragma once

#include <span>

#include "tactile_net/lab/answer.hpp"

namespace tactile_net::lab {

/// Noise, deviations, intervals, the cells that touch, and what presses: forces and centre of all
/// cells, and of each contact those of the cells that lie nearest to it. Under constraints the
/// tractions are the cones', the rest is the mixture's.
///
/// @param smoothed  the variance of place that smoothing may have added to a contact
/// @pre  the answer has a mixture and tractions
void add_mixture_bands(FrameAnswer& answer, const SkinSceneProblem& problem,
                       std::span<const double> readings, double smoothed);

/// How much of a load's force its cells may be off by, as they cannot have its shape, and how much
/// of the largest reading they miss in each. By the square of their size: measured of contacts of a
/// tenth of a depth to two of them (docs/internals/mixture.md).
[[nodiscard]] double share_of_cells(const SkinSceneProblem& problem);

}  // namespace tactile_net::lab
