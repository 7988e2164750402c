/// @file
/// Readings and tractions as grids that reflections turn round, of lines and skins. Private.
#pragma once

#include <span>

#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/realtime/product_plan.hpp"

namespace tactile_net {

/// The channels, a block each, with the parities of their kernels for normal tractions. A line's
/// places are one row, in which the loops of a frame take them, at any distances from each other.
/// Of no size where the channels' taxels are no rows and columns, or differ.
[[nodiscard]] GridBlocks reading_grid(const LinearProblem& problem);

/// Whether the readings without a weight are each other's images, under every reflection of their
/// grid and, where it has partners, the exchange of y and z.
[[nodiscard]] bool mirrors_itself(const GridBlocks& readings, std::span<const double> weights);

/// The components of the tractions, a block each, with their parities.
[[nodiscard]] GridBlocks traction_grid(const LinearProblem& problem);

}  // namespace tactile_net
