/// @file
/// A linear method made ready: readings in, tractions out, one matrix-vector product a frame.
#pragma once

#include <span>

#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/realtime/frame_status.hpp"

namespace tactile_net {

/// f = M g. Built by `tikhonov`, by `TikhonovFamily` (tikhonov_family.hpp) and by `closed_form`
/// (thesis/closed_form.hpp).
class Reconstruction {
 public:
  /// @param matrix     M [Pa per reading], (unknowns x count) x (channels x count)
  /// @param condition  2-norm condition number of the system behind M, >= 1
  /// @throw std::invalid_argument  M is empty, not finite, or its size is not rows x columns
  Reconstruction(const Matrix& matrix, double condition);

  /// One frame: O(readings x tractions), no allocation, no lock, no exception; const, so threads
  /// may share one object. Sums in a fixed order: equal frames give equal bits.
  ///
  /// `too_large` if any traction, or a partial sum of it, would not be finite.
  ///
  /// @param readings   g, `readings()` values
  /// @param tractions  f [Pa], `tractions()` values, the normal ones first; untouched unless the
  ///                   status is `ok`; must not overlap `readings`
  FrameStatus solve(std::span<const double> readings, std::span<double> tractions) const noexcept;

  [[nodiscard]] std::size_t readings() const noexcept { return transposed_.rows; }
  [[nodiscard]] std::size_t tractions() const noexcept { return transposed_.columns; }

  /// M' itself: row j holds what a unit of reading j adds to every traction.
  [[nodiscard]] const Matrix& transposed() const noexcept { return transposed_; }

  /// Condition number of the stacked system: relative errors of its entries, rounding included,
  /// reach the tractions multiplied by about this.
  [[nodiscard]] double condition() const noexcept { return condition_; }

 private:
  [[nodiscard]] double traction(std::span<const double> readings, std::size_t row) const noexcept;

  Matrix transposed_;
  double condition_;
  double safe_;  // readings up to this overflow no sum
};

/// Minimises the functional of linear_problem.hpp for a line by a QR of the stacked matrix
/// [W K; sqrt(alpha) L]: backward stable, P is never formed. O((m + n) n^2) for K of m x n.
///
/// @param alpha  weight of the smoothness [unit of (W K)^2], > 0
/// @throw std::invalid_argument  alpha is not > 0 and finite, or the problem is a skin's
/// @throw std::domain_error      the stacked matrix is rank deficient in double precision
[[nodiscard]] Reconstruction tikhonov(const LinearProblem& problem, double alpha);

/// One frame solved directly, without building M: as `tikhonov`, cheaper for a single frame. Of a
/// skin by a QR of the whole problem in the waves of its stabiliser, O((m + n) min(m, n)^2):
/// no symmetry is used, so that it checks what `TikhonovFamily` finds by classes and singular
/// values.
///
/// @return f [Pa], components x values
/// @throw as `tikhonov`; std::invalid_argument if readings have the wrong size or are not finite
[[nodiscard]] std::vector<double> tikhonov_solve(const LinearProblem& problem, double alpha,
                                                 std::span<const double> readings);

}  // namespace tactile_net
