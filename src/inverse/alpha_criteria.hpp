/// @file
/// What the rules for alpha minimise, and its slope. Private.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/inverse/alpha_tables.hpp"

namespace tactile_net {

inline constexpr std::size_t alpha_steps = 200;
inline constexpr auto alpha_count = static_cast<std::ptrdiff_t>(alpha_steps);

/// Of the influence matrix H at one alpha.
struct Traces {
  double kept = 0.0;             ///< tr H
  double left = 0.0;             ///< tr (I - H); rows less tr H would lose its digits
  double square = 0.0;           ///< tr H^2
  double log_determinant = 0.0;  ///< of I - H
};

/// What a rule adds to its function of the frame; 0 for those that add nothing.
[[nodiscard]] double penalty(AlphaRule rule, const Traces& traces, double rows) noexcept;

/// Lukas' factor, which keeps rgcv from too small an alpha.
[[nodiscard]] inline double robustness(const Traces& traces, double rows) noexcept {
  return 0.1 + 0.9 * traces.square / rows;
}

[[nodiscard]] constexpr std::size_t index(AlphaRule rule) noexcept {
  return static_cast<std::size_t>(rule);
}

/// Everything relative to gamma's largest value; a row per step of alpha.
struct AlphaTables::Parts {
  /// @param like  absent: alphas span this gamma; else they are those of `like`, gamma is relative
  ///              to its largest one, and values at a step can be added up
  /// @throw std::invalid_argument  as `AlphaTables`
  Parts(std::span<const double> all_gamma, std::size_t all_rows, std::span<const double> all_shares,
        const Parts* like = nullptr);

  /// log alpha of a step.
  [[nodiscard]] double at(std::size_t step) const noexcept;
  [[nodiscard]] double alpha(double log_alpha) const noexcept;
  [[nodiscard]] Traces traces(double log_alpha) const noexcept;
  /// Of component i in a trace.
  [[nodiscard]] double share(std::size_t i) const noexcept {
    return shares.empty() ? 1.0 : shares[i];
  }

  std::vector<double> gamma{};     ///< as given
  std::vector<double> shares{};    ///< as given
  std::vector<double> relative{};  ///< over the largest; 0 for those that outnumber the rows
  std::size_t rows = 0;
  double largest = 0.0;
  double unexplained = 0.0;            ///< rows less the components that show in them
  double low = 0.0;                    ///< log of the smallest alpha
  std::size_t first = 0, last = 0;     ///< steps at the squares of the smallest and largest gamma
  std::vector<double> alphas{};        ///< at every step
  Eigen::VectorXd relative_alphas{};   ///< over the largest gamma's square
  bool cannot_estimate_noise = false;  ///< see `AlphaTables`
  Eigen::MatrixXd lost{};              ///< 1 - phi, a column per step
  /// What the squares of a frame's coefficients are multiplied by, in blocks of rows for
  /// `FrameCurves`.
  Eigen::MatrixXd weights{};
  std::array<Eigen::VectorXd, alpha_rules.size()> penalties{};  ///< at every step

 private:
  void fill();
};

/// Sums over a frame's components, at every step. Lengths are squares over the frame's scale.
struct FrameCurves {
  Eigen::VectorXd residual;      ///< rho^2
  Eigen::VectorXd log_residual;  ///< its logarithm
  Eigen::VectorXd fit;           ///< g'(I - H) g
  Eigen::VectorXd size;          ///< |L f|^2
  Eigen::VectorXd rate;          ///< its slope in the logarithm of the root of alpha
};

/// @throw std::invalid_argument  the frame is of another family, or has not one beta a gamma
void check_family(const FilterFrame& frame, const AlphaTables::Parts& tables);

/// What every rule is a function of: a frame, over gamma's largest value.
class Criteria {
 public:
  /// @throw std::invalid_argument  noise_rms is not >= 0; the frame is of another family
  Criteria(const FilterFrame& frame, const AlphaTables::Parts& tables,
           std::optional<double> noise_rms);

  [[nodiscard]] bool silent() const noexcept {
    return !(frame_.scale > 0.0) || !(tables_.largest > 0.0);
  }

  /// What the rule makes least at every step; for discrepancy the log of residual over noise.
  [[nodiscard]] std::vector<double> values(AlphaRule rule);
  /// What vanishes at the choice: the slope of that in log alpha; for discrepancy the log itself.
  [[nodiscard]] double zero(AlphaRule rule, double log_alpha);

  /// |L (f_a - f_b)| / |L f_b| for two alphas.
  [[nodiscard]] double difference(double log_a, double log_b) const;

 private:
  const FrameCurves& curves();
  [[nodiscard]] double log_target() const;  // rho of the discrepancy
  [[nodiscard]] std::vector<double> whiteness() const;
  double whiteness_slope(double log_alpha);
  [[nodiscard]] double curvature_slope(double log_alpha) const;
  [[nodiscard]] double zero_from_sums(AlphaRule rule, double log_alpha) const;

  const FilterFrame& frame_;
  const AlphaTables::Parts& tables_;
  double rows_;
  double noise_ = 0.0;            // sigma, over the scale
  std::vector<double> power_of_;  // squares of the coefficients
  std::optional<FrameCurves> curves_;
  std::vector<double> left_, change_, power_, power_slope_;
};

}  // namespace tactile_net
