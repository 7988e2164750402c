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
  /// Of `SkinFamily::solve`; of the family on a face, of `SkinCone::solve`: what the cones hold is
  /// then taken for certain. O(columns). Shares the family's factors.
  ///
  /// @param prior_alpha  > 0; the same as alpha: the posterior covariance
  /// @throw std::invalid_argument  alpha or prior_alpha is not > 0 and finite
  SkinCovariance(const SkinFamily& family, double alpha, double prior_alpha);

  /// O(columns x readings), and the first time that the family is asked a transform of each
  /// component.
  [[nodiscard]] std::vector<double> deviations() const override;
  /// As `deviations`, and sums over windows.
  [[nodiscard]] std::vector<double> window_deviations(const SkinGrid& grid,
                                                      const CellWindow& window) const override;
  /// O(columns x readings) of the classes.
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  /// One product for all. Sums over a single traction of each component, as the margin of a cell
  /// is, take O(readings) each.
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

/// |W (K f - g)|, of weighted readings: what tractions leave of them. O(readings x tractions).
/// @throw std::invalid_argument  a size does not fit
[[nodiscard]] double residual_norm(const SkinProblem& problem, std::span<const double> readings,
                                   std::span<const double> tractions);

/// The noise as the residual shows it, beside the noise that was stated. @param stated_rms  of one
/// weighted reading, >= 0 @throw std::invalid_argument  a size does not fit
[[nodiscard]] NoiseEstimate estimate_noise(const SkinProblem& problem,
                                           std::span<const double> readings,
                                           std::span<const double> tractions,
                                           double degrees_of_freedom,
                                           std::optional<double> stated_rms = {});

}  // namespace tactile_net
