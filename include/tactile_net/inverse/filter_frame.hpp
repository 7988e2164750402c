/// @file
/// One frame of readings in a basis where Tikhonov's method is diagonal.
///
/// With generalised singular values gamma_i of (W K, L) and coefficients beta_i of the readings,
/// the minimiser for any alpha keeps phi_i = gamma_i^2 / (gamma_i^2 + alpha) of each component
/// (Hansen, Discrete Inverse Problems, 2010, ch. 4-5). Rules for alpha need no more than this.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace tactile_net {

/// The periodogram of the residual, which the rule NCP asks for.
class ResidualPeriodogram {
 public:
  ResidualPeriodogram() = default;
  ResidualPeriodogram(const ResidualPeriodogram&) = delete;
  ResidualPeriodogram& operator=(const ResidualPeriodogram&) = delete;
  virtual ~ResidualPeriodogram() = default;

  /// Number of frequencies, the mean left out.
  [[nodiscard]] virtual std::size_t size() const noexcept = 0;

  /// Power at each frequency, of the residual whose components in the basis are `left`, and its
  /// derivative when `left` changes by `change`. All channels are added.
  virtual void power(std::span<const double> left, std::span<const double> change,
                     std::span<double> values, std::span<double> slopes) const = 0;

  /// Power at each frequency of several residuals at once, without derivatives.
  ///
  /// @param left    components of one residual after another
  /// @param values  `size()` of one residual after another
  virtual void powers(std::span<const double> left, std::size_t components,
                      std::span<double> values) const;
};

struct FilterFrame {
  std::vector<double> gamma{};  ///< generalised singular values, >= 0; any order
  std::vector<double> beta{};   ///< the readings' coefficients, over `scale`
  /// How many components of the readings each gamma stands for; empty: one. Where an array is seen
  /// in sections (long_array_family.hpp) a gamma stands for a part of every section.
  std::vector<double> shares{};
  /// Used in place of beta^2 in sums over the frame; empty: beta^2 is used. Set by families that
  /// approximate; those of sections may be negative, by as much as sections deviate from the whole.
  std::vector<double> powers{};
  double outside = 0.0;  ///< norm of what no traction explains, over `scale`
  double scale = 0.0;    ///< largest |W g|; 0: nothing was read
  std::size_t rows = 0;  ///< readings that count: rows with a weight
  std::shared_ptr<const ResidualPeriodogram> periodogram{};
};

}  // namespace tactile_net
