/// @file
/// The inverse problem of a skin (inverse/linear_problem.hpp), made of the skin, its material and
/// options.
///
///     const SkinArray skin{.rows = 16, .columns = 16, .pitch_y = 2e-3, .pitch_z = 2e-3,
///                          .depths = {3e-3}, .reads = reads};
///     const LinearProblem problem = make_problem(skin, silicone, SkinProblemOptions{});
///     const TikhonovFamily family(problem);                   // inverse/tikhonov_family.hpp
///     const FilterFrame frame = family.analyse(readings);
///     const double alpha = choose_alpha(frame, AlphaRule::rgcv).alpha;
///     const std::vector<double> tractions = family.solve(frame, alpha);
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/grid.hpp"

namespace tactile_net {

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
[[nodiscard]] LinearProblem make_problem(const SkinArray& skin, const Material& material,
                                         const SkinProblemOptions& options = {});

}  // namespace tactile_net
