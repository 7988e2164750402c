/// @file
/// A skin of taxels in two dimensions, flat or curved: what they read of contacts, and which
/// tractions explain what they read.
///
///     const SkinArray skin{.rows = 16, .columns = 16, .pitch_y = 2e-3, .pitch_z = 2e-3,
///                          .depths = {4e-3}, .reads = {Quantity::stress_x}};
///     const LinearProblem problem = make_problem(skin, material);
///     const TikhonovFamily family(problem);
///     const FilterFrame frame = family.analyse(readings);
///     const auto tractions = family.solve(frame, choose_alpha(frame, AlphaRule::aicc).alpha);
#pragma once

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/load_mixture.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/curved_skin.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tactile_net/skin/resultant.hpp"
#include "tactile_net/skin/space_wrench.hpp"
