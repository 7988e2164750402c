/// @file
/// What the rules for alpha ask of a family of solutions, whatever the frame: made once for a
/// recording, it leaves each frame a few products of matrices.
///
///     const AlphaTables tables(family.singular_values(), rows);
///     const AlphaSweep sweep = sweep_alpha(family.analyse(readings), tables);  // frame by frame
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "tactile_net/inverse/alpha.hpp"

namespace tactile_net {

class AlphaTables {
 public:
  /// The filters phi_i at the 200 alphas of a sweep. O(200 x components), five numbers for each.
  ///
  /// @param gamma   as `FilterFrame::gamma`, of every frame
  /// @param rows    as `FilterFrame::rows`
  /// @param shares  as `FilterFrame::shares`
  /// @throw std::invalid_argument  shares are neither none nor one for each gamma
  AlphaTables(std::span<const double> gamma, std::size_t rows, std::span<const double> shares = {});
  ~AlphaTables();
  AlphaTables(AlphaTables&&) noexcept;
  AlphaTables& operator=(AlphaTables&&) noexcept;

  /// True if fewer than 5 readings' worth of components, tr (I - H) where 1 % of the largest gamma
  /// is half kept, are left to tell the noise by: taxels no closer than their depth, or very few. A
  /// rule that needs no noise then takes signal for noise.
  [[nodiscard]] bool few_rows() const noexcept;

  struct Parts;
  [[nodiscard]] const Parts& parts() const noexcept { return *parts_; }

 private:
  std::unique_ptr<const Parts> parts_;
};

/// The rule for whoever names none: aicc, which hardly ever is more than twice as wrong as the best
/// alpha. Of few rows (see there) evidence, which needs the noise; where that is not known gml, the
/// least wrong of those that guess it, with the verdict `noise_needed`. Measured by bench_alpha:
/// docs/internals/alpha.md.
[[nodiscard]] AlphaRule default_rule(const AlphaTables& tables, bool noise_known) noexcept;

/// The rule that sizes the prior of bands: evidence where the noise that is stated is relied on,
/// else gml, which bears another noise. Other rules find the best tractions, and a prior that is
/// too small (docs/internals/decisions.md).
[[nodiscard]] constexpr AlphaRule prior_rule(bool relies_on_noise) noexcept {
  return relies_on_noise ? AlphaRule::evidence : AlphaRule::gml;
}

/// `sweep_alpha` and `choose_alone` of a frame whose gamma and rows are those of the tables: the
/// same answers to rounding.
///
/// @throw std::invalid_argument  as those; the frame's gamma or rows are others
[[nodiscard]] AlphaSweep sweep_alpha(const FilterFrame& frame, const AlphaTables& tables,
                                     std::optional<double> noise_rms = {});
[[nodiscard]] AlphaChoice choose_alone(const FilterFrame& frame, const AlphaTables& tables,
                                       AlphaRule rule, std::optional<double> noise_rms = {});

}  // namespace tactile_net
