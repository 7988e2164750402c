/// @file
/// What noise and smoothing move a force by where tractions are constrained. Private.
///
/// Noise can only push where nothing may pull, in every cell that touches nothing, and what
/// smoothing leaves beside a contact is cut where it is negative and kept where it is positive. No
/// curvature at the answer tells of either. So the contact that was found is read and solved again,
/// once with noise and once with the same noise turned round, whose own part cancels: by how much
/// more presses than was put in is what the first answer has got too much, nearly.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "lab/skin_method.hpp"
#include "tactile_net/lab/skin_problem.hpp"

namespace tactile_net::lab {

/// A contact alone; what presses elsewhere is noise, and left out.
struct ContactAlone {
  std::vector<double> tractions;       ///< that were found
  std::span<const std::size_t> cells;  ///< of the contact
  std::span<const double> weights;     ///< of the readings
  std::vector<double> read;            ///< W K of the tractions in these cells
};

/// @param solve      readings, without weights, under the constraints
/// @param noise_rms  of a weighted reading
/// @return           of the force on these cells, what is too much of it, over it; 0 where nothing
///                   presses, or the solutions end without an answer. Within +-0.5.
[[nodiscard]] double constraint_bias(
    const ContactAlone& contact, const std::function<ConeSolution(std::span<const double>)>& solve,
    double noise_rms);

/// The same of a skin with all of its matrix.
[[nodiscard]] double constraint_bias(const SkinSceneProblem& problem, const SkinMethod& method,
                                     std::span<const double> tractions,
                                     std::span<const std::size_t> cells, double alpha,
                                     double noise_rms);

}  // namespace tactile_net::lab
