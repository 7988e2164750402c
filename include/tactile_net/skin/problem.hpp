/// @file
/// The inverse problem of a skin: which tractions f explain the readings g = K f?
///
/// The functional is that of inverse/problem.hpp in two dimensions:
///
///     |P W (K f - g)|^2 + alpha A/P sum_u w_u^2 sum_cells (f_u^2 + l^2 |grad f_u|^2)
///
/// The projector P before W takes the unknown constant out of each channel; it is 1 where offsets
/// are known. The gradient is made of differences between neighbouring cells over their distance,
/// none beyond the grid's ends (Neumann); l = smoothing length; A/P = area of a cell over that of a
/// taxel; w = 1 for the normal traction, w = tangential_weight for the tangential ones.
/// The sums are integrals, and A/P weighs them as integrals: alpha, tractions and bands of sums do
/// not follow the grid's spacing. The deviation of a single cell does, as log(l / spacing)^(1/2): a
/// point's value has no bound in 2-D.
///
///     const SkinArray skin{.rows = 16, .columns = 16, .pitch_y = 2e-3, .pitch_z = 2e-3,
///                          .depths = {3e-3}, .reads = reads};
///     const SkinProblem problem = make_problem(skin, silicone, SkinProblemOptions{});
///     const SkinFamily family(problem);                       // family.hpp
///     const FilterFrame frame = family.analyse(readings);
///     const double alpha = choose_alpha(frame, AlphaRule::rgcv).alpha;
///     const std::vector<double> tractions = family.solve(frame, alpha);
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/problem.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/grid.hpp"

namespace tactile_net {

struct SkinProblem {
  Matrix kernel{};  ///< W K, readings x (components x cells); P W K where offsets are unknown
  std::vector<double> weights{};  ///< diagonal of W, one per row; 0 for a dead taxel
  std::vector<Site> sites{};      ///< where each row's reading is taken
  std::size_t taxels = 0;
  std::size_t components = 3;      ///< 1: normal traction; 3: tangential_y and tangential_z too
  SkinGrid grid{};                 ///< the cells of each component
  double area = 1.0;               ///< A/P, of a cell over that of a taxel
  double smoothing_length = 0.0;   ///< l [m], >= 0
  double tangential_weight = 1.0;  ///< w of the tangential tractions, > 0
  double kernel_error = 0.0;       ///< how far rounding may have moved the kernel, in the 2-norm
  bool unknown_offsets = false;    ///< each channel has a constant, which P removes
  /// What P takes from W K, channels x columns: along W 1 of each channel, over its 2-norm.
  Matrix constants{};
};

struct SkinProblemOptions {
  std::size_t components = 3;                ///< 1 or 3
  std::optional<double> smoothing_length{};  ///< l [m], >= 0; absent: the taxels' mean depth
  double tangential_weight = 1.0;            ///< w, > 0; unused with one component
  std::vector<double> channel_rms{};         ///< noise of each channel; empty: rows not weighted
  std::vector<std::size_t> dead_taxels{};    ///< indices < taxel_count; their rows get weight 0
  SkinGridOptions grid{};
  bool unknown_offsets = false;  ///< each channel's readings have a constant that is not known
};

/// True if a frame says anything: there is a living taxel, or, where offsets are unknown, two in
/// one channel.
[[nodiscard]] bool is_measured(const SkinArray& skin, std::span<const std::size_t> dead_taxels,
                               bool unknown_offsets);

/// @throw std::invalid_argument  the skin, the material or an option is out of range, as
///                               `make_problem`
void check(const SkinArray& skin, const Material& material, const SkinProblemOptions& options);

/// Assembles W K: one block of rows per channel, one of columns per component. Where the taxels lie
/// on the grid's lattice each distance is computed once.
///
/// Readings that cannot tell the tractions apart (observability.hpp) still have an answer for
/// alpha > 0, the smallest that explains them.
///
/// @throw std::invalid_argument  skin, material or an option is out of range; every taxel is dead,
///                               or unknown offsets leave nothing; stresses, strains and
///                               displacements are mixed without `channel_rms`; a displacement
///                               along the surface in a layer that slips, with tangential tractions
///                               as unknowns; more than `most_kernel_entries`
[[nodiscard]] SkinProblem make_problem(const SkinArray& skin, const Material& material,
                                       const SkinProblemOptions& options = {});

/// Leaves these taxels out, as if they had been dead when the problem was made.
void leave_out(SkinProblem& problem, std::span<const std::size_t> taxels);

/// P W g, the readings in the form in which `kernel` times tractions explains them.
/// @throw std::invalid_argument  readings have the wrong size
[[nodiscard]] std::vector<double> weighted(const SkinProblem& problem,
                                           std::span<const double> readings);

/// The constant of each channel that fits the tractions best [unit of its readings]; 0 where all of
/// its taxels are dead. Empty where offsets are known.
/// @throw std::invalid_argument  readings or tractions have the wrong size
[[nodiscard]] std::vector<double> offsets(const SkinProblem& problem,
                                          std::span<const double> readings,
                                          std::span<const double> tractions);

/// Independent numbers in a frame: rows with a weight, less one for each channel with an unknown
/// offset.
[[nodiscard]] std::size_t independent_readings(const SkinProblem& problem);

/// P = (WK)'(WK) + alpha L'L, the matrix of the conductance network: symmetric, positive definite
/// for alpha > 0. Squares K's condition number; `SkinFamily` does not solve with it. O(rows x
/// columns^2).
///
/// @throw std::invalid_argument  alpha is not > 0
[[nodiscard]] Matrix normal_matrix(const SkinProblem& problem, double alpha);

/// b = (WK)' W g, the currents into the conductance network whose matrix is `normal_matrix`.
/// @throw std::invalid_argument  readings have the wrong size
[[nodiscard]] std::vector<double> normal_right_side(const SkinProblem& problem,
                                                    std::span<const double> readings);

}  // namespace tactile_net
