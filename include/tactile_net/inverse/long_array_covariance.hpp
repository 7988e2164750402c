/// @file
/// Bands of an array too long for one decomposition (target tactile_net::spectral).
///
/// The covariance of covariance.hpp without its factors: every traction's deviation from the
/// sections of long_array_family.hpp, and sums over the whole array, such as the force, exactly, by
/// conjugate gradients: with x = P^-1 weights their variance is
///
///     |W K x|^2 + alpha^2 / prior_alpha |L x|^2
#pragma once

#include <cstddef>
#include <list>
#include <span>
#include <utility>
#include <vector>

#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"
#include "tactile_net/inverse/long_array_family.hpp"

namespace tactile_net {

class LongArrayCovariance final : public Covariance {
 public:
  /// @param family       kept by reference
  /// @param solver       of the same problem; its buffers are used by every call below
  /// @param alpha        of the tractions; the solver takes it
  /// @param prior_alpha  as `TractionCovariance`'s
  /// @throw std::invalid_argument  alpha or prior_alpha is not > 0 and finite
  LongArrayCovariance(const LongArrayFamily& family, FftTikhonov& solver, double alpha,
                      double prior_alpha);

  [[nodiscard]] std::vector<double> deviations() const override;
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override;

 private:
  /// A root of the covariance times the weights. Those asked for last are kept: a contact's force,
  /// moment and angle ask for the same few again and again. Valid until other 23 are asked for.
  const std::vector<double>& image(std::span<const double> weights) const;

  const LongArrayFamily& family_;
  FftTikhonov& solver_;
  double alpha_, prior_alpha_;
  mutable std::list<std::pair<std::vector<double>, std::vector<double>>> images_{};  // last first
};

}  // namespace tactile_net
