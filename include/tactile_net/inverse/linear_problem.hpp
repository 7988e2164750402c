/// @file
/// The inverse problem of a line or a skin: which tractions f explain the readings g = K f?
///
/// All matrix methods minimise the same functional (thesis 4.3, with the unit it hides made
/// explicit, in one dimension or two):
///
///     |P W (K f - g)|^2 + alpha m sum_u w_u^2 sum_values (f_u^2 + l^2 |grad f_u|^2)
///
/// with the differences between neighbouring values over their distance for the gradient, l the
/// smoothing length, and m the length or area that a value stands for over that of a taxel. The
/// sums over the surface are integrals, and m weighs them as integrals: so neither alpha nor the
/// tractions nor the bands of their sums follow the spacing. The deviation of a single cell of a
/// skin does, as log(l / spacing)^(1/2): a point's value has no bound in 2-D. What lies beyond the
/// first and the last value of an axis is the grid's `Boundary`. The thesis' tractions lie at the
/// taxels of a line, where m = 1.
///
/// w = 1 for the normal traction u and w = tangential_weight for the tangential ones: a priori a
/// tangential traction is w times smaller than the normal one. Drag of a friction mu is 1/mu times
/// smaller; with w = 1 readings that hardly tell the two apart share a press between them. How it
/// is estimated: tangential_weight.hpp.
///
/// P = 1 where readings have no constant that nobody knows. Where each channel's have one,
/// |W (K f + o - g)|^2 is minimised by the constants o, too, which no stabiliser holds. The best of
/// them leave P W (K f - g), P the orthogonal projector that takes each channel's constant W 1
/// away: so P W K stands for W K and P W g for W g, in all that follows, and a frame has one
/// independent number less a channel.
///
/// Two assemblies know elasticity and make a problem: line_problem.hpp of a line, skin/problem.hpp
/// of a skin.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/sensing/site.hpp"
#include "tactile_net/sensing/surface_cells.hpp"
#include "tactile_net/sensing/surface_grid.hpp"

namespace tactile_net {

struct LinearProblem {
  Matrix kernel{};  ///< W K, readings x (components x values); P W K where offsets are unknown
  std::vector<double> weights{};  ///< diagonal of W, one per row; 0 for a dead taxel
  std::vector<Site> sites{};      ///< where each row's reading is taken
  std::size_t taxels = 0;         ///< places of the readings
  std::size_t components = 1;     ///< of the tractions, the first of `skin_tractions`: 1 or 2 of a
                                  ///< line, 1 or 3 of a skin
  SurfaceGrid grid{};             ///< the values of each component
  /// Of a curved skin what each value of a component stands for; null: the grid says it all. Then
  /// the grid is that of the chart, and tractions are per area of the chart: times grid.area() over
  /// a cell's own they are those on its surface.
  std::shared_ptr<const std::vector<SurfaceCell>> cells{};
  /// Of a line: one column in plane strain, whose forces are per metre of width. A skin of one
  /// column is a skin.
  bool is_line = false;
  double measure = 1.0;            ///< m: of a value over that of a taxel, > 0
  double smoothing_length = 0.0;   ///< l [m], >= 0
  double tangential_weight = 1.0;  ///< w of the tangential tractions, > 0
  double kernel_error = 0.0;       ///< how far rounding may have moved the kernel, in the 2-norm
  bool unknown_offsets = false;    ///< each channel has a constant, which P removes
  /// What P takes from W K, channels x columns: along W 1 of each channel, over its 2-norm.
  Matrix constants{};
};

/// Largest number of entries of K: 1 GB.
inline constexpr std::size_t most_kernel_entries = std::size_t{1} << 27;

/// Leaves these taxels out, as if they had been dead when the problem was made.
void leave_out(LinearProblem& problem, std::span<const std::size_t> taxels);

/// P W g, the readings in the form in which `kernel` times tractions explains them.
/// @throw std::invalid_argument  readings have the wrong size
[[nodiscard]] std::vector<double> weighted(const LinearProblem& problem,
                                           std::span<const double> readings);

/// The constant of each channel that fits the tractions best [unit of its readings]; 0 where all of
/// its taxels are dead. Empty where offsets are known.
/// @throw std::invalid_argument  a size does not fit
[[nodiscard]] std::vector<double> offsets(const LinearProblem& problem,
                                          std::span<const double> readings,
                                          std::span<const double> tractions);

/// Independent numbers in a frame: rows with a weight, less one for each channel with an unknown
/// offset.
[[nodiscard]] std::size_t independent_readings(const LinearProblem& problem);

/// Number of readings of each channel; where channels differ in length, of all channels together.
[[nodiscard]] std::size_t channel_length(const LinearProblem& problem);

/// P = (WK)'(WK) + alpha L'L, the matrix of the conductance network (thesis 5.18): symmetric,
/// positive definite for alpha > 0. Squares K's condition number: for circuits and for users who
/// ask for it; no method of this library solves with it. O(rows x columns^2).
///
/// @throw std::invalid_argument  alpha is not > 0
[[nodiscard]] Matrix normal_matrix(const LinearProblem& problem, double alpha);

/// b = (WK)' W g, the currents into the conductance network whose matrix is `normal_matrix`.
///
/// @throw std::invalid_argument  readings have the wrong size
[[nodiscard]] std::vector<double> normal_right_side(const LinearProblem& problem,
                                                    std::span<const double> readings);

}  // namespace tactile_net
