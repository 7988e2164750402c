/// @file
/// Tikhonov's method on a skin for every alpha at once.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"

namespace tactile_net {

struct ActiveFace;

/// The generalised singular values and vectors of (W K, L), as `TikhonovFamily`.
///
/// L is diagonal in cosines along y and z, exactly. A cosine has even or odd parity about the
/// grid's middle, and so has a kernel: where the taxels (places, readings, weights) mirror
/// themselves in y, in z or in both, the problem falls into two or four smaller ones, a class each,
/// without an approximation. Nothing is squared.
class SkinFamily {
 public:
  /// O(rows x columns x min(rows, columns)); with 4 classes a 16th of it.
  explicit SkinFamily(const LinearProblem& problem);

  /// The family on a face of the friction cones (cone.hpp): directions that the face holds are no
  /// unknowns. Rules for alpha and covariances then judge those that are left.
  ///
  /// @throw std::invalid_argument  the face leaves nothing free, or is of another problem
  SkinFamily(const LinearProblem& problem, const ActiveFace& face);
  ~SkinFamily();
  SkinFamily(SkinFamily&&) noexcept;
  SkinFamily& operator=(SkinFamily&&) noexcept;

  /// gamma, class after class, min(readings, tractions) of each class. Empty where no reading
  /// depends on the tractions.
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

  /// The frame in the basis of the singular vectors, without a periodogram: the rule ncp is for
  /// lines alone. O(rows x columns), with 4 classes a quarter.
  /// @throw std::invalid_argument  readings have the wrong size or are not finite
  [[nodiscard]] FilterFrame analyse(std::span<const double> readings) const;

  /// The minimiser for one alpha [Pa]: normal tractions of all cells, then tangential ones.
  /// @throw std::invalid_argument  alpha is not > 0 and finite; the frame is of another family
  [[nodiscard]] std::vector<double> solve(const FilterFrame& frame, double alpha) const;

  /// The matrix from readings to the minimiser for one alpha, for many frames.
  /// @throw std::invalid_argument  alpha is not > 0 and finite
  [[nodiscard]] Reconstruction reconstruction(double alpha) const;

  struct Factors;
  /// The decomposition, which covariances share.
  [[nodiscard]] std::shared_ptr<const Factors> factors() const noexcept { return factors_; }

 private:
  std::shared_ptr<const Factors> factors_;
};

}  // namespace tactile_net
