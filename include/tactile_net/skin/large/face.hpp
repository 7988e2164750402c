/// @file
/// Bands of a contact on a large skin where constraints hold what does not touch (target
/// tactile_net::spectral): `SkinCovariance` of the family on a face, by one solve a sum.
///
///     const LargeSkinPart part(skin, pad, options, problem, contact, reach);
///     const ConeFace face = part.face(solution.face);
///     const FilterFrame frame = LargeSkinFamily(part.system(), face).analyse(left);
///     const LargeSkinFaceCovariance held(part, face, alpha, prior_alpha, degrees, free);
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/skin/cone.hpp"
#include "tactile_net/skin/large/part.hpp"

namespace tactile_net {

/// Tractions that the face does not leave free are taken for certain, and so are those beyond the
/// part. Weights are of all tractions of the whole skin; those beyond the part count as 0.
class LargeSkinFaceCovariance final : public Covariance {
 public:
  /// @param part                kept by reference, as `free` is
  /// @param face                of the part
  /// @param alpha, prior_alpha  > 0
  /// @param degrees_of_freedom  tr H on the face
  /// @param free                of the whole, without constraints: it has what single cells do, for
  ///                            which a solve each would be too many, and what no solve reaches
  /// @throw std::invalid_argument  an alpha is not > 0 and finite; nothing is free
  LargeSkinFaceCovariance(const LargeSkinPart& part, const ConeFace& face, double alpha,
                          double prior_alpha, double degrees_of_freedom, const Covariance& free);
  ~LargeSkinFaceCovariance() override;

  /// Those without constraints, which are more.
  [[nodiscard]] std::vector<double> deviations() const override;
  /// Of weights in a single cell that without constraints.
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  /// Of several sums all are without constraints where a solve for one does not come to its end:
  /// what they say of each other is of one covariance.
  [[nodiscard]] std::vector<double> deviations_of(
      std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] Matrix covariances(std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override;
  /// Whether every solve so far came to its end; sums for which one did not have the variance
  /// without constraints.
  [[nodiscard]] bool converged() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tactile_net
