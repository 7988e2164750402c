/// @file
/// Tikhonov's method for every alpha at once.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/active_face.hpp"
#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"

namespace tactile_net {

/// The minimisers of a problem for every alpha: the generalised singular value decomposition (GSVD)
/// of the pair (W K, L).
///
/// L is diagonal in waves along y and z, exactly: in cosines, or in sines where tractions fall to 0
/// beyond the grid's ends. A wave has even or odd parity about the grid's middle, and so has a
/// kernel: where the taxels (places, readings, weights) mirror themselves in y, in z or in both,
/// the problem falls into two or four smaller ones, a class each, without an approximation. A line
/// has two. Nothing is squared.
class TikhonovFamily {
 public:
  /// O(rows x columns x min(rows, columns)); with 2 classes a quarter of it, with 4 a 16th.
  explicit TikhonovFamily(const LinearProblem& problem);

  /// The family on a face of the constraints (constrained.hpp, inverse/cone_tikhonov.hpp):
  /// directions that the face holds are no unknowns. Rules for alpha and covariances then judge
  /// those that are left. One class.
  ///
  /// @throw std::invalid_argument  the face leaves nothing free, or is of another problem
  TikhonovFamily(const LinearProblem& problem, const ActiveFace& face);
  ~TikhonovFamily();
  TikhonovFamily(TikhonovFamily&&) noexcept;
  TikhonovFamily& operator=(TikhonovFamily&&) noexcept;

  /// gamma, class after class, each class's descending: min(readings, tractions) values of each, so
  /// that the largest need not be the first. Empty where no reading depends on the tractions.
  [[nodiscard]] std::span<const double> singular_values() const noexcept;

  /// Number of mirror classes into which the problem falls: 1, 2 or 4.
  [[nodiscard]] std::size_t classes() const noexcept;

  /// 2-norm condition number of [W K L^-1; sqrt(alpha) I]: relative errors of the frame, rounding
  /// included, reach L f multiplied by at most about this.
  [[nodiscard]] double condition(double alpha) const noexcept;

  /// Upper bound of the 2-norm condition number of [W K; sqrt(alpha) L] itself: `condition` times
  /// that of L.
  [[nodiscard]] double stacked_condition(double alpha) const noexcept;

  /// tr H: how many of the readings' degrees of freedom the tractions of one alpha use up.
  [[nodiscard]] double degrees_of_freedom(double alpha) const noexcept;

  /// The frame in the basis of the singular vectors. O(rows x columns), with 4 classes a quarter.
  ///
  /// Of a line it has a periodogram (rule ncp), which is worked out when a
  /// rule first asks for it, for the family's first frame in O(rows^2 x columns).
  /// @throw std::invalid_argument  readings have the wrong size or are not finite
  [[nodiscard]] FilterFrame analyse(std::span<const double> readings) const;

  /// The minimiser for one alpha [Pa], as `tikhonov_solve`: normal tractions of all values, then
  /// tangential ones.
  /// @throw std::invalid_argument  alpha is not > 0 and finite; the frame is of another family
  [[nodiscard]] std::vector<double> solve(const FilterFrame& frame, double alpha) const;

  /// The matrix from readings to the minimiser for one alpha, (components x values) x readings.
  /// @throw std::invalid_argument  alpha is not > 0 and finite; the matrix is not finite
  [[nodiscard]] Matrix matrix(double alpha) const;

  /// The same made ready for many frames, with its condition: the exact one of a line, which takes
  /// as much work as the family, and else, or on a face, `stacked_condition`.
  /// @throw as `matrix`; std::domain_error  the exact condition is beyond double precision
  [[nodiscard]] Reconstruction reconstruction(double alpha) const;

  struct Factors;
  /// The decomposition, which covariances share.
  [[nodiscard]] std::shared_ptr<const Factors> factors() const noexcept { return factors_; }

 private:
  std::shared_ptr<const Factors> factors_;  // with periodograms of frames
};

}  // namespace tactile_net
