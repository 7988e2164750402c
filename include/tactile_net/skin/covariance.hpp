/// @file
/// How far a skin's tractions may be from the truth: as inverse/uncertainty.hpp, class by class.
///
///     const double prior = choose_alone(frame, AlphaRule::gml).alpha;
///     const SkinCovariance covariance(family, alpha, prior);
///     const std::vector<double> deviations = covariance.deviations();  // times the noise: bands
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/skin/cell_window.hpp"
#include "tactile_net/skin/family.hpp"

namespace tactile_net {

class SkinCovariance final : public CellCovariance {
 public:
  /// The covariance of what `SkinFamily::solve` finds; with a family on a face, of what
  /// `SkinCone::solve` finds: directions that the cones hold are taken to be exact. O(columns).
  /// Shares the family's factors.
  ///
  /// @param prior_alpha  > 0; the same as alpha: the posterior covariance
  /// @throw std::invalid_argument  alpha or prior_alpha is not > 0 and finite
  SkinCovariance(const SkinFamily& family, double alpha, double prior_alpha);

  /// O(columns x readings); the first call for a family also transforms each component.
  [[nodiscard]] std::vector<double> deviations() const override;
  /// Costs as much as `deviations`, and the sums over windows.
  [[nodiscard]] std::vector<double> window_deviations(const SurfaceGrid& grid,
                                                      const CellWindow& window) const override;
  /// O(columns x readings), class by class.
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  /// One product for all sums. Sums over a single traction of each component, as the margin of a
  /// cell is, take O(readings) each.
  [[nodiscard]] std::vector<double> deviations_of(
      std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] Matrix covariances(std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override { return degrees_; }

 private:
  struct Sums;
  [[nodiscard]] Sums sums(std::span<const std::vector<double>> weights) const;

  std::shared_ptr<const SkinFamily::Factors> factors_;

  std::vector<double> sizes_{};  // standard deviation of each component
  double hidden_ = 0.0;          // of what no reading shows
  double degrees_;
};

}  // namespace tactile_net
