/// @file
/// Tikhonov's method for every alpha at once.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"

namespace tactile_net {

/// The generalised singular values and vectors of (W K, L). With the triangle R of a QR of L, which
/// is well conditioned, they are those of W K R^-1, by one SVD; nothing is squared.
class TikhonovFamily {
 public:
  /// O(rows x columns^2).
  explicit TikhonovFamily(const LinearProblem& problem);

  /// The family on one face of the cone of `ConstrainedTikhonov`: variables held at zero are no
  /// unknowns. Rules for alpha then judge the tractions that are left.
  ///
  /// @param free  columns of `edges`, as in `ConstrainedSolution`, at least one
  /// @throw std::invalid_argument  none is free; as `edges`
  TikhonovFamily(const LinearProblem& problem, const Constraints& constraints,
                 std::span<const std::size_t> free);
  ~TikhonovFamily();
  TikhonovFamily(TikhonovFamily&&) noexcept;
  TikhonovFamily& operator=(TikhonovFamily&&) noexcept;

  /// gamma, descending; min(readings, tractions) values.
  [[nodiscard]] std::span<const double> singular_values() const noexcept;

  /// 2-norm condition number of [W K R^-1; sqrt(alpha) I]: relative errors of the frame, rounding
  /// included, reach R f multiplied by at most about this.
  [[nodiscard]] double condition(double alpha) const noexcept;

  /// Upper bound of the 2-norm condition number of [W K; sqrt(alpha) L] itself: `condition` times
  /// one on R's, sqrt(1 + 4 l^2/h^2) times the weights' ratio, because the eigenvalues of Q lie
  /// between 0 and 4.
  [[nodiscard]] double stacked_condition(double alpha) const noexcept;

  /// tr H: how many of the readings' degrees of freedom the tractions of one alpha use up.
  [[nodiscard]] double degrees_of_freedom(double alpha) const noexcept;

  /// The frame in the basis of the singular vectors. O(rows x columns); its periodogram is worked
  /// out when a rule first asks for it, for the family's first frame in O(rows^2 x columns).
  /// @throw std::invalid_argument  readings have the wrong size or are not finite
  [[nodiscard]] FilterFrame analyse(std::span<const double> readings) const;

  /// The minimiser for one alpha [Pa], as `tikhonov`. O(columns^2).
  /// @throw std::invalid_argument  alpha is not > 0 and finite; the frame is of another family
  [[nodiscard]] std::vector<double> solve(const FilterFrame& frame, double alpha) const;

  /// The matrix from readings to the minimiser for one alpha, for many frames: that of `tikhonov`,
  /// made of the family's singular vectors. O(rows x columns^2).
  /// @throw std::invalid_argument, std::domain_error  as `tikhonov`
  [[nodiscard]] Reconstruction reconstruction(double alpha) const;

  struct Factors;
  [[nodiscard]] const Factors& factors() const noexcept { return *factors_; }

 private:
  std::shared_ptr<const Factors> factors_;  // with periodograms of frames
};

}  // namespace tactile_net
