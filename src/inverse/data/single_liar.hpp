/// @file
/// What shows that one taxel lies. In a frame that contacts explain a narrow contact beside it
/// takes up most of what it says too much, and the sum over all readings leaves room for the rest.
/// Private.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/sensing/site.hpp"

namespace tactile_net {

/// The taxels with the largest residuals, largest first.
/// @param sites  of each row
[[nodiscard]] std::vector<std::size_t> suspects(std::span<const double> residual,
                                                std::span<const Site> sites, std::size_t taxels);

/// What the sum over a taxel's readings takes of noise by chance, whichever the taxel is.
[[nodiscard]] double taxel_gain(double readings, std::size_t taxels);

[[nodiscard]] double sum_of_squares(std::span<const double> residual) noexcept;

/// Tells from residuals whether a taxel lies. Residuals and readings are over the noise.
class SingleLiar {
 public:
  /// @param rows  independent ones
  explicit SingleLiar(double rows);

  /// A residual is larger than noise has its largest in 19 frames of 20: only then is it worth
  /// while to leave out a taxel.
  [[nodiscard]] bool may_be_in(std::span<const double> residual) const noexcept;
  /// By a gain in squares that neither noise nor an error of the model is likely to have, and that
  /// leaves nothing odd.
  ///
  /// @param before   what the best contact leaves
  /// @param without  what the best one leaves of the rest; 0 at the taxel
  /// @param chance   `taxel_gain`
  /// @param seen     all readings
  [[nodiscard]] bool is_found(std::span<const double> before, std::span<const double> without,
                              double chance, std::span<const double> seen) const noexcept;
  /// Whether leaving out any taxel may make such a gain: what is left may not fall below 0.
  [[nodiscard]] static bool may_gain(std::span<const double> before, double chance,
                                     std::span<const double> seen) noexcept;

 private:
  double largest_;
};

}  // namespace tactile_net
