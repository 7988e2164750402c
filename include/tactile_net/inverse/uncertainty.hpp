/// @file
/// What the bands of tractions (covariance.hpp) mean for the contact's force, and the noise that
/// they are multiplied by.
///
///     const NoiseEstimate noise =
///         estimate_noise(problem, readings, tractions, covariance.degrees_of_freedom());
///     const UncertainResultant contact =
///         resultant_of(problem, tractions, covariance, noise.rms());
///     contact.normal.deviation;  // [N/m]; examples/04_uncertainty.cpp
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <tuple>

#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/numeric/distribution.hpp"
#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

/// The noise as the residual shows it, beside the noise that was stated.
struct NoiseEstimate {
  double residual_rms = 0.0;  ///< rms of a weighted reading: |W (K f - g)| / sqrt(rows - tr H)
  std::optional<double> stated_rms{};
  /// sqrt(residual^2 - stated^2), where the residual exceeds what 99 % of white noise would leave:
  /// an error of the model as large as this per reading; 0: the noise stated explains the residual.
  double model_rms = 0.0;

  /// What the bands should use: the stated noise, or else the residual's.
  [[nodiscard]] double rms() const noexcept { return stated_rms.value_or(residual_rms); }
};

/// |P W (K f - g)|: what tractions leave of the weighted readings. O(readings x tractions).
/// @throw std::invalid_argument  a size does not fit
[[nodiscard]] double residual_norm(const LinearProblem& problem, std::span<const double> readings,
                                   std::span<const double> tractions);

/// Estimates the noise from the residual of tractions, beside the noise that was stated.
///
/// @param degrees_of_freedom  tr H
/// @param stated_rms          of one weighted reading, >= 0; absent: not known
/// @throw std::invalid_argument  a size does not fit
[[nodiscard]] NoiseEstimate estimate_noise(const LinearProblem& problem,
                                           std::span<const double> readings,
                                           std::span<const double> tractions,
                                           double degrees_of_freedom,
                                           std::optional<double> stated_rms = {});

/// Estimates the noise from the 2-norm of the weighted residual.
/// @param rows  number of rows with a weight
[[nodiscard]] NoiseEstimate estimate_noise(double residual, std::size_t rows,
                                           double degrees_of_freedom,
                                           std::optional<double> stated_rms = {});

/// A value and its standard deviation.
struct Uncertain {
  double value = 0.0;
  double deviation = 0.0;
  /// Of its distribution, where that is known (load_mixture.hpp): no Gaussian's, and not always
  /// with the value in its middle.
  std::optional<CentralInterval> interval{};

  static constexpr auto described = std::tuple{
      field("value", &Uncertain::value, "What was found."),
      field("deviation", &Uncertain::deviation, "One standard deviation of it."),
      field(
          "interval", [](const auto& one) { return IfAny<CentralInterval>{one.interval}; },
          "What it lies in, by the quantiles of all that the readings leave possible; "
          "absent: only the deviation is known.")};
};

/// The contact's force, by first-order propagation of the covariance.
struct UncertainResultant {
  Uncertain normal{};                     ///< F_v = D sum f_v [N/m]
  std::optional<Uncertain> tangential{};  ///< F_t [N/m]; absent with one unknown
  std::optional<Uncertain> centre{};      ///< sum y f_v / sum f_v [m]; absent if F_v <= 0
  std::optional<Uncertain> angle{};  ///< atan2(F_t, F_v) [rad]; absent with one unknown or F_v <= 0
  /// Covariance of (F_v, F_t, centre), 3 x 3 row-major; zero where one of the two is absent.
  std::array<double, 9> covariance{};
};

/// Resultant of a problem's tractions.
/// @param noise_rms  of one weighted reading
[[nodiscard]] UncertainResultant resultant_of(const LinearProblem& problem,
                                              std::span<const double> tractions,
                                              const Covariance& covariance, double noise_rms);

/// Resultant of tractions on a surface: all normal values, then all tangential ones.
/// @param noise_rms  of one weighted reading
[[nodiscard]] UncertainResultant resultant_of(const Surface& surface,
                                              std::span<const double> tractions,
                                              const Covariance& covariance, double noise_rms);

/// Of the values from `first` to before `last`, with nothing elsewhere.
[[nodiscard]] UncertainResultant resultant_between(std::size_t first, std::size_t last,
                                                   const Surface& surface,
                                                   std::span<const double> tractions,
                                                   const Covariance& covariance, double noise_rms);

/// What the values from `first` to before `last` amount to.
using ResultantBetween = std::function<UncertainResultant(std::size_t first, std::size_t last)>;

/// Deviations of the whole force: more of it than noise alone hardly ever makes.
inline constexpr double deviations_that_press = 3.0;
/// And the least of each of several contacts.
inline constexpr double deviations_of_part = 6.0;

/// Resultant of the contact that needs the most friction, where several lie apart. F_v and F_t of
/// the whole are sums: two contacts dragged in opposite directions both slip while F_t is 0.
/// Absent: there is one contact, or no tangential traction.
///
/// @param whole      resultant of all tractions: a force below six of its deviations is no contact
/// @param between    of the contact; null: `resultant_between`
[[nodiscard]] std::optional<UncertainResultant> nearest_to_slipping(
    const Surface& surface, std::span<const double> tractions, const Covariance& covariance,
    double noise_rms, const UncertainResultant& whole, const ResultantBetween& between = {});

}  // namespace tactile_net
