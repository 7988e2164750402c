/// @file
/// What tractions on a curved skin amount to in the sensor's own axes, each value with its
/// deviation.
///
///     UncertainWrench wrench = resultant_of(problem.grid, f, cells, covariance, rms);
///     wrench.space = space_wrench(problem, f, cells, covariance, rms, wrench, {});
///     wrench.space->force[2];                 // [N], along the sensor's z
#pragma once

#include <cstddef>
#include <span>

#include "tactile_net/inverse/contact_patch.hpp"
#include "tactile_net/sensing/surface_cells.hpp"

namespace tactile_net {

/// Force, moment and centre of the tractions of some cells: by first-order propagation of the
/// covariance, and of what else the wrench on the chart is doubted by.
///
/// @param problem    with cells
/// @param tractions  as the problem has them, per area of the chart [Pa]
/// @param cells      to sum over
/// @param noise_rms  of one weighted reading
/// @param chart      `resultant_of` these cells, with all its doubts
/// @param about      of moments, in the sensor's axes [m]
/// @throw std::invalid_argument  a size does not fit, or the problem has no cells
[[nodiscard]] SpaceWrench space_wrench(const LinearProblem& problem,
                                       std::span<const double> tractions,
                                       std::span<const std::size_t> cells,
                                       const Covariance& covariance, double noise_rms,
                                       const UncertainWrench& chart, const SpaceVector& about);

/// Tractions per area of the chart as those on the surface, or deviations of them.
/// @param tractions  as the problem has them [Pa]
void put_on_surface(const LinearProblem& problem, std::span<double> tractions);

}  // namespace tactile_net
