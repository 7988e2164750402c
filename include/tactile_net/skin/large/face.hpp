/// @file
/// Bands of a contact on a large skin where constraints hold what does not touch (target
/// tactile_net::spectral): `TractionCovariance` of the family on a face, by one solve a sum.
///
///     const LargeSkinPart part(skin, pad, options, problem, contact, reach);
///     const ActiveFace face = part.face(solution.face);
///     const FilterFrame frame = LargeSkinFamily(part.system(), face).analyse(left);
///     const LargeSkinFaceCovariance held(part, face, alpha, prior_alpha, degrees, free);
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/active_face.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/skin/large/part.hpp"

namespace tactile_net {

/// Covariance of the tractions that a face leaves free. All other tractions, and those beyond the
/// part, are taken to be exact. Weights are one per traction of the whole skin; those beyond the
/// part count as 0.
class LargeSkinFaceCovariance final : public Covariance {
 public:
  /// @param part                kept by reference, as `free` is
  /// @param face                its cells are cells of the part
  /// @param alpha, prior_alpha  > 0
  /// @param degrees_of_freedom  tr H on the face
  /// @param free                covariance of the whole skin without constraints: used for single
  ///                            cells, where a solve each would take too long, and where a solve
  ///                            does not converge
  /// @throw std::invalid_argument  an alpha is not > 0 and finite; nothing is free
  LargeSkinFaceCovariance(const LargeSkinPart& part, const ActiveFace& face, double alpha,
                          double prior_alpha, double degrees_of_freedom, const Covariance& free);
  ~LargeSkinFaceCovariance() override;

  /// Deviations without constraints (of `free`), which are larger.
  [[nodiscard]] std::vector<double> deviations() const override;
  /// By one solve; for weights in a single cell the deviation without constraints.
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  /// If a solve for one sum does not converge, all sums get the covariance without constraints: so
  /// the deviations are those of one covariance.
  [[nodiscard]] std::vector<double> deviations_of(
      std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] Matrix covariances(std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override;
  /// True if every solve so far converged; a sum whose solve did not has the variance without
  /// constraints.
  [[nodiscard]] bool converged() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tactile_net
