/// @file
/// What the rules for alpha minimise, and its slope. Private.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "tactile_net/inverse/alpha_tables.hpp"

namespace tactile_net {

inline constexpr std::size_t alpha_steps = 200;

/// Everything relative to gamma's largest value; a row per step of alpha.
struct AlphaTables::Parts {
  std::vector<double> gamma{};     ///< as given
  std::vector<double> relative{};  ///< over the largest
  std::size_t rows = 0;
  double largest = 0.0;
  double low = 0.0;        ///< log of the smallest alpha; that of the largest is 0
  Eigen::MatrixXd lost{};  ///< 1 - phi, a column per step
  /// What the squares of a frame's coefficients are multiplied by, in blocks of rows for
  /// `FrameCurves`.
  Eigen::MatrixXd weights{};
  Eigen::VectorXd trace{}, square{}, log_determinant{};  ///< of H, of H^2, of I - H
};

/// Sums over a frame's components, at every step. Lengths are squares over the frame's scale.
struct FrameCurves {
  Eigen::VectorXd residual;  ///< rho^2
  Eigen::VectorXd fit;       ///< g'(I - H) g
  Eigen::VectorXd size;      ///< |L f|^2
  Eigen::VectorXd rate;      ///< its slope in the logarithm of the root of alpha
};

/// What every rule is a function of: a frame, over gamma's largest value.
class Criteria {
 public:
  /// @throw std::invalid_argument  noise_rms is not >= 0; the frame is of another family
  Criteria(const FilterFrame& frame, const AlphaTables::Parts& tables,
           std::optional<double> noise_rms);

  [[nodiscard]] bool silent() const noexcept {
    return !(frame_.scale > 0.0) || !(tables_.largest > 0.0);
  }
  /// log alpha of a step.
  [[nodiscard]] double at(std::size_t step) const noexcept;
  [[nodiscard]] double alpha(double log_alpha) const noexcept;

  /// What the rule makes least at every step; for discrepancy the log of residual over noise.
  [[nodiscard]] std::vector<double> values(AlphaRule rule);
  /// The slope of that in log alpha.
  [[nodiscard]] double slope(AlphaRule rule, double log_alpha);
  /// The value of discrepancy anywhere.
  [[nodiscard]] double misfit(double log_alpha) const;

  /// |L (f_a - f_b)| / |L f_b| for two alphas.
  [[nodiscard]] double difference(double log_a, double log_b) const;

 private:
  const FrameCurves& curves();
  [[nodiscard]] std::vector<double> whiteness() const;
  double whiteness_slope(double log_alpha);
  [[nodiscard]] double curvature_slope(double log_alpha) const;
  [[nodiscard]] double slope_from_sums(AlphaRule rule, double log_alpha) const;

  const FilterFrame& frame_;
  const AlphaTables::Parts& tables_;
  double rows_;
  double target_ = 0.0;
  std::vector<double> power_of_;  // squares of the coefficients
  std::optional<FrameCurves> curves_;
  std::vector<double> left_, change_, power_, power_slope_;
};

}  // namespace tactile_net
