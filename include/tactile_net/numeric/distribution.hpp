/// @file
/// What is known of a number: a mixture of possibilities, in each of which it is Gaussian or
/// follows Student's t.
///
///     const std::vector<Distribution::Component> two = {
///         {.probability = 0.7, .mean = 1.0, .scale = 0.1},
///         {.probability = 0.3, .mean = 1.4, .scale = 0.3}};
///     const Distribution force(two);
///     const CentralInterval band = force.interval(0.95);  // 2.5 % lie below band.low
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "tactile_net/numeric/fields.hpp"

namespace tactile_net {

/// The central part of a distribution.
struct CentralInterval {
  double level = 0.95;  ///< the probability in it, as much left out below as above
  double low = 0.0;
  double high = 0.0;

  static constexpr auto described = std::tuple{
      field("level", &CentralInterval::level, "The probability that the value lies inside."),
      field("low", &CentralInterval::low, "As much of the rest lies below this ..."),
      field("high", &CentralInterval::high, "... as above this.")};
};

class Distribution {
 public:
  /// One possibility: x = (mean + scale t) / (divisor + divisor_scale u), where t and u are
  /// standard Gaussian, or Student's of the distribution's degrees of freedom. Without a divisor
  /// that is a number with its scale; with one it is the ratio of two sums, and exact (Fieller
  /// 1954) as far as the divisor is certainly not 0.
  struct Component {
    double probability = 1.0;    ///< >= 0; those of all are divided by their sum
    double mean = 0.0;           ///< of x, or of the ratio's numerator
    double scale = 0.0;          ///< >= 0; 0: it is certain
    double divisor = 1.0;        ///< mean of the denominator, > 0
    double divisor_scale = 0.0;  ///< of the denominator, >= 0
    double covariance = 0.0;     ///< scale times divisor_scale times the correlation of t and u
  };

  /// Certain to be 0.
  Distribution() : Distribution(std::vector<Component>(1)) {}
  /// @param degrees  of freedom, > 0; infinity: Gaussian
  /// @throw std::invalid_argument  there is no component, or a value is not finite or out of range
  explicit Distribution(std::vector<Component> components,
                        double degrees = std::numeric_limits<double>::infinity());

  /// Of max(x, least): what is known of a number that cannot be less.
  /// @throw std::invalid_argument  x is a ratio; least is not finite
  [[nodiscard]] Distribution at_least(double least) const;

  /// Of the number and an independent error of this deviation, which has the distribution's form.
  /// @throw std::invalid_argument  the deviation is not >= 0 and finite
  [[nodiscard]] Distribution moved_by(double deviation) const;

  /// Of a ratio the mean numerator over the mean denominator, since it has no other.
  [[nodiscard]] double mean() const noexcept { return mean_; }
  /// Standard deviation; of a ratio to first order. Infinite of up to two degrees of freedom.
  [[nodiscard]] double deviation() const noexcept { return deviation_; }
  /// Infinity: the components are Gaussian.
  [[nodiscard]] double degrees_of_freedom() const noexcept { return degrees_; }
  [[nodiscard]] std::span<const Component> components() const noexcept { return components_; }

  /// The probability that the number is at most x.
  [[nodiscard]] double cdf(double x) const;
  /// The least x with cdf(x) >= p, by Newton's steps between bounds: about five `cdf`.
  /// @throw std::invalid_argument  p is not between 0 and 1, both excluded
  [[nodiscard]] double quantile(double p) const;
  /// The central interval. @throw std::invalid_argument  level is not between 0 and 1
  [[nodiscard]] CentralInterval interval(double level = 0.95) const;
  /// The continuous ranked probability score of a truth x: the integral of (cdf(t) - [t >= x])^2,
  /// in the number's unit, the smaller the better (Gneiting and Raftery 2007). By a Gauss rule
  /// between the components' quantiles: some thousand `cdf`, for whoever tests bands.
  [[nodiscard]] double crps(double x) const;

 private:
  class Rising;
  [[nodiscard]] double standard_cdf(double z) const;
  /// Of a component: the probability that it is at most x.
  [[nodiscard]] double cdf_of(const Component& one, double x) const;
  void find_moments();

  std::vector<Component> components_;
  double degrees_;
  std::optional<double> least_{};
  double mean_ = 0.0;
  double deviation_ = 0.0;
};

}  // namespace tactile_net
