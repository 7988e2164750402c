/// @file
/// What a cell's tractions amount to in the sensor's own axes. Private.
#pragma once

#include <cstddef>

#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/sensing/surface_cells.hpp"

namespace tactile_net {

/// Of 1 Pa of one component, as a problem has it: per area of the chart.
struct CellWrench {
  SpaceVector force{};   ///< [N]
  SpaceVector moment{};  ///< [N m]
};

/// @param about  of the moment, in the sensor's axes [m]
/// @pre  the problem has cells
[[nodiscard]] inline CellWrench cell_wrench(const LinearProblem& problem, std::size_t cell,
                                            std::size_t component, const SpaceVector& about) {
  const SurfaceCell& of = problem.cells->at(cell);
  const double on_surface = problem.grid.area() / of.area;
  const SpaceVector force = multiple(on_surface, of.force[component]);
  return {force, combined(on_surface, of.moment[component], -1.0, cross(about, force))};
}

}  // namespace tactile_net
