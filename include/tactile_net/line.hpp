/// @file
/// A line of taxels: what they read of a contact, and which tractions explain what they read.
///
///     const SensorArray array{
///         .count = 41, .pitch = 0.5e-3, .depths = {1.5e-3}, .reads = {Quantity::stress_x}};
///     const LinearProblem problem = make_problem(array, material, {.smoothing_length = 1.5e-3});
///     const TikhonovFamily family(problem);
///     const FilterFrame frame = family.analyse(readings);
///     const auto tractions = family.solve(frame, choose_alpha(frame, AlphaRule::rgcv).alpha);
#pragma once

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/contact_patch.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/load_mixture.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/sensing/resultant.hpp"
#include "tactile_net/sensing/traction_field.hpp"
