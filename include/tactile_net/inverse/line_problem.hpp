/// @file
/// The inverse problem of a line array (linear_problem.hpp), made of the array, its material and
/// options.
///
/// A problem and a method that solves it:
///
///     const SensorArray array{
///         .count = 41, .pitch = 0.5e-3, .depths = {1.5e-3}, .reads = {Quantity::stress_x}};
///     const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};
///     const LineProblemOptions options{.smoothing_length = 1.5e-3,
///                                      .surface = {.basis = SurfaceBasis::hats}};
///     const LinearProblem problem = make_problem(array, silicone, options);
///     const Reconstruction method = tikhonov(problem, 1e-3);  // reconstruction.hpp
///     const FrameStatus status = method.solve(readings, tractions);  // examples/01_tractions.cpp
#pragma once

#include <cstddef>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

/// Most columns of K that a scene may ask for by a spacing of its own: decomposing more takes
/// minutes.
inline constexpr std::size_t most_columns = 4096;

struct LineProblemOptions {
  std::size_t unknowns = 1;                ///< 1: normal traction; 2: the tangential one too
  double smoothing_length = 0.0;           ///< l [m], >= 0; the scene reader takes the first depth
  double tangential_weight = 1.0;          ///< w, > 0; with one unknown nothing depends on it
  std::vector<double> channel_rms{};       ///< noise of each channel; empty: rows not weighted
  std::vector<std::size_t> dead_taxels{};  ///< indices < count; their rows get weight 0
  SurfaceOptions surface{};      ///< default: a line load over each taxel, for dense arrays alone
  bool unknown_offsets = false;  ///< each channel's readings have a constant that is not known
};

/// @throw std::invalid_argument  the array, the material or an option is out of range
void check(const SensorArray& array, const Material& material, const LineProblemOptions& options);

/// True if a frame says anything: there is a living taxel, or, where offsets are unknown, two in
/// one channel.
[[nodiscard]] bool is_measured(const SensorArray& array, const LineProblemOptions& options);

/// Assembles W K: one block of rows per channel, one of columns per unknown; for regular arrays
/// from `surface_kernel`, for irregular ones from a `HatKernel` for each quantity and depth.
///
/// With two unknowns, one channel cannot tell them apart, and some pairs leave null modes (see
/// `identifiability`): alpha > 0 still gives an answer, the smallest that explains the readings.
///
/// @throw std::invalid_argument  array, material or an option is out of range; every taxel is dead;
///                               stresses and strains are mixed without `channel_rms`; two unknowns
///                               from one channel; unknown offsets leave nothing; K has more than
///                               `most_kernel_entries`
[[nodiscard]] LinearProblem make_problem(const SensorArray& array, const Material& material,
                                         const LineProblemOptions& options = {});

}  // namespace tactile_net
