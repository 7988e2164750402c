/// @file
/// The kernel of a curved skin's problem. Private.
#pragma once

#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// What a curved skin asks of its material.
/// @throw std::invalid_argument  it is no bonded layer, or thicker than its surface's radius
void check_curved(const SkinArray& skin, const Material& material);

/// The grid of the chart of a skin whose kernel is given.
[[nodiscard]] SurfaceGrid given_grid(const SkinArray& skin);

/// Fills in W K and its error.
/// @pre  the problem has cells, of this skin
void add_curved_kernel(const SkinArray& skin, const Material& material, LinearProblem& problem);

}  // namespace tactile_net
