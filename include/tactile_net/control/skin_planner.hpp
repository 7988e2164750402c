/// @file
/// From a skin's inverse problem to a controller's plan: as planner.hpp, in two dimensions.
///
/// A regular skin is its own image in y and in z, and M = P^-1 K' W falls into four classes,
/// exactly: a quarter of its numbers. A square one is its image too when y and z are exchanged, and
/// half of that is left: 16 x 16 taxels that read three stresses stream 0.9 MB where M has 7.4 MB.
/// Low rank pays for deep skins and coarse accuracies alone; it is tried. Dead taxels break the
/// symmetry: M without them is that of the whole skin, on readings whose missing ones are filled in
/// with what the live ones predict, exactly; where so many are dead that this is dearer, M itself
/// is taken. Irregular skins take M, or two factors of low rank.
///
///     const SkinFamily family(problem);
///     const PlannedEstimator planned =
///         plan_estimator(problem, family, 1e-4, {.accuracy = 1e-7, .friction_coefficient = 0.5});
///     ContactEstimator estimator(planned.plan);    // examples/10_skin_controller.cpp
#pragma once

#include "tactile_net/control/planner.hpp"
#include "tactile_net/skin/family.hpp"

namespace tactile_net {

/// Plans a skin's controller for one alpha. The bound is that of `PlannerOptions::accuracy`, for
/// every frame: what was cut off and how factors were rounded is measured on the whole matrix, sums
/// are bounded (Higham 2002, 3.1).
///
/// O(readings x tractions) each for the classes of the reflections, and a singular value
/// decomposition of each; with diagnostics O(readings^2 x tractions).
///
/// @param family   the problem's
/// @param options  `allow_fft` is not read: up to 32 x 32 taxels classes are cheaper. With
///                 `noise_rms` forces are summed over the cells that touch
/// @param whole    where taxels are dead: the same problem with none; absent: not known, and its
///                 symmetry is not used
/// @throw std::invalid_argument  alpha or accuracy is not > 0 and finite; the family or the whole
///                               is of another problem; a structure is asked for that the skin does
///                               not have; the calibration is not one of these readings
[[nodiscard]] PlannedEstimator plan_estimator(const LinearProblem& problem,
                                              const SkinFamily& family, double alpha,
                                              const PlannerOptions& options = {},
                                              const LinearProblem* whole = nullptr);

/// Largest memory that planning takes, the problem and its family included [bytes]. Compare it with
/// what the machine has before making either.
[[nodiscard]] double planning_bytes(std::size_t readings, std::size_t tractions) noexcept;

}  // namespace tactile_net
