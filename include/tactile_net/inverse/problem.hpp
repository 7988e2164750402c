/// @file
/// The inverse problem: which tractions f explain the readings g = K f?
///
/// All matrix methods minimise the same functional (thesis 4.3, with the unit it hides made
/// explicit; h = spacing of the surface's values, l = smoothing length, differences between
/// neighbours, D = pitch):
///
///     |W (K f - g)|^2 + alpha h/D sum_u w_u^2 (|f_u|^2 + l^2/h^2 sum_j (f_{u,j+1} - f_{u,j})^2)
///
/// with w = 1 for the normal traction u and w = tangential_weight for the tangential one: a priori
/// the tangential traction is w times smaller than the normal one. Drag of a friction mu is 1/mu
/// times smaller; with w = 1 a pair of readings that hardly tells the two apart shares a press
/// between them. How it is estimated: tangential_weight.hpp.
///
/// The sums over the surface are integrals, and h/D weighs them as integrals: so neither alpha nor
/// the tractions nor their bands follow the spacing. Hats fall to 0 beyond the first and the last
/// value, which counts as a difference. The thesis' tractions lie at the taxels, where h = D.
///
/// Where a channel's readings have a constant that nobody knows, |W (K f + o - g)|^2 is minimised
/// by the constants o, too, which no stabiliser holds. The best of them leave P W (K f - g), P the
/// orthogonal projector that takes each channel's constant W 1 away: so P W K stands for W K and
/// P W g for W g, in all that follows, and a frame has one independent number less a channel.
///
/// A problem and a method that solves it:
///
///     const SensorArray array{
///         .count = 41, .pitch = 0.5e-3, .depths = {1.5e-3}, .reads = {Quantity::stress_x}};
///     const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};
///     const ProblemOptions options{.smoothing_length = 1.5e-3,
///                                  .surface = {.basis = SurfaceBasis::hats}};
///     const InverseProblem problem = make_problem(array, silicone, options);
///     const Reconstruction method = tikhonov(problem, 1e-3);  // reconstruction.hpp
///     const FrameStatus status = method.solve(readings, tractions);  // examples/01_tractions.cpp
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

struct InverseProblem {
  Matrix kernel{};  ///< W K, readings x (unknowns x surface.count); P W K where offsets are unknown
  std::vector<double> weights{};   ///< diagonal of W, one per row; 0 for a dead taxel
  std::vector<Site> sites{};       ///< where each row's reading is taken
  std::size_t taxels = 0;          ///< places along y
  std::size_t unknowns = 1;        ///< 1: normal traction; 2: normal, then tangential
  Surface surface{};               ///< the places of each unknown's values
  double smoothing_length = 0.0;   ///< l [m], >= 0
  double tangential_weight = 1.0;  ///< w, the tangential traction's L over the normal one's; > 0
  double kernel_error = 0.0;       ///< how far rounding may have moved the kernel, in the 2-norm
  bool unknown_offsets = false;    ///< each channel has a constant, which P removes
  /// What P takes from W K, channels x columns: along W 1 of each channel, over its 2-norm.
  Matrix constants{};
};

/// Largest number of entries of K: 1 GB.
inline constexpr std::size_t most_kernel_entries = std::size_t{1} << 27;

/// Most columns of K that a scene may ask for by a spacing of its own: decomposing more takes
/// minutes.
inline constexpr std::size_t most_columns = 4096;

struct ProblemOptions {
  std::size_t unknowns = 1;                ///< 1: normal traction; 2: the tangential one too
  double smoothing_length = 0.0;           ///< l [m], >= 0; the scene reader takes the first depth
  double tangential_weight = 1.0;          ///< w, > 0; with one unknown nothing depends on it
  std::vector<double> channel_rms{};       ///< noise of each channel; empty: rows not weighted
  std::vector<std::size_t> dead_taxels{};  ///< indices < count; their rows get weight 0
  SurfaceOptions surface{};      ///< default: a line load over each taxel, for dense arrays alone
  bool unknown_offsets = false;  ///< each channel's readings have a constant that is not known
};

/// @throw std::invalid_argument  the array, the material or an option is out of range
void check(const SensorArray& array, const Material& material, const ProblemOptions& options);

/// True if a frame says anything: there is a living taxel, or, where offsets are unknown, two in
/// one channel.
[[nodiscard]] bool is_measured(const SensorArray& array, const ProblemOptions& options);

/// Assembles K: one block of rows per channel, one of columns per unknown; for regular arrays from
/// `surface_kernel`, for irregular ones from a `HatKernel` for each quantity and depth.
///
/// With two unknowns, one channel cannot tell them apart, and some pairs leave null modes (see
/// `identifiability`): alpha > 0 still gives an answer, the smallest that explains the readings.
///
/// @throw std::invalid_argument  array, material or an option is out of range; every taxel is dead;
///                               stresses and strains are mixed without `channel_rms`; two unknowns
///                               from one channel; unknown offsets leave nothing; K has more than
///                               `most_kernel_entries`
[[nodiscard]] InverseProblem make_problem(const SensorArray& array, const Material& material,
                                          const ProblemOptions& options = {});

/// Leaves these taxels out, as if they had been dead when the problem was made.
void leave_out(InverseProblem& problem, std::span<const std::size_t> taxels);

/// P W g, the readings in the form in which `kernel` times tractions explains them.
/// @throw std::invalid_argument  readings have the wrong size
[[nodiscard]] std::vector<double> weighted(const InverseProblem& problem,
                                           std::span<const double> readings);

/// The constant of each channel that fits the tractions best [unit of its readings]; 0 where all of
/// its taxels are dead. Empty where offsets are known.
/// @throw std::invalid_argument  a size does not fit
[[nodiscard]] std::vector<double> offsets(const InverseProblem& problem,
                                          std::span<const double> readings,
                                          std::span<const double> tractions);

/// Independent numbers in a frame: rows with a weight, less one for each channel with an unknown
/// offset.
[[nodiscard]] std::size_t independent_readings(const InverseProblem& problem);

/// Number of readings of each channel; where channels differ in length, of all channels together.
[[nodiscard]] std::size_t line_length(const InverseProblem& problem);

/// P = (WK)'(WK) + alpha (l^2/D^2 Q + I), the matrix of the conductance network (thesis 5.18; alpha
/// stands for alpha h/D, for the tangential traction times its weight squared, and D for h):
/// symmetric, positive definite for alpha > 0. Squares K's condition number: for circuits and for
/// users who ask for it; `tikhonov` does not solve with it.
///
/// @throw std::invalid_argument  alpha is not > 0
[[nodiscard]] Matrix normal_matrix(const InverseProblem& problem, double alpha);

/// b = (WK)' W g, the currents into the conductance network whose matrix is `normal_matrix`.
///
/// @throw std::invalid_argument  readings have the wrong size
[[nodiscard]] std::vector<double> normal_right_side(const InverseProblem& problem,
                                                    std::span<const double> readings);

}  // namespace tactile_net
