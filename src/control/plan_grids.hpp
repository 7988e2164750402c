/// @file
/// Readings and tractions as grids that reflections turn round, of lines and skins. Private.
#pragma once

#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/realtime/product_plan.hpp"

namespace tactile_net {

/// True if the tractions are a line's: values in one column, one metre wide. Its plan has forces
/// per metre of width and no cells.
[[nodiscard]] bool is_line(const LinearProblem& problem) noexcept;

/// The channels, a block each, with the parities of their kernels for normal tractions. A line's
/// places are one row, in which the loops of a frame take them, at any distances from each other.
/// Of no size where the channels' taxels are no rows and columns, or differ.
[[nodiscard]] GridBlocks reading_grid(const LinearProblem& problem);

/// The components of the tractions, a block each, with their parities.
[[nodiscard]] GridBlocks traction_grid(const LinearProblem& problem);

}  // namespace tactile_net
