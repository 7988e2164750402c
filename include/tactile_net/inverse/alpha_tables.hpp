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

  /// True if the readings cannot tell the noise's rms: less than 5 is left for it of tr(I - H), at
  /// the alpha that keeps half of a component with 1 % of the largest gamma. So it is with very few
  /// taxels, or taxels no closer than their depth. A rule that guesses the rms then takes signal
  /// for noise.
  [[nodiscard]] bool cannot_estimate_noise() const noexcept;

  struct Parts;
  [[nodiscard]] const Parts& parts() const noexcept { return *parts_; }

 private:
  std::unique_ptr<const Parts> parts_;
};

/// The rule for callers who name none: aicc, which is hardly ever more than twice as wrong as the
/// best alpha. Where `AlphaTables::cannot_estimate_noise`: evidence if the noise's rms is known,
/// else gml, the least wrong of the rules that guess it, with the verdict `noise_needed`. Measured
/// by bench_alpha: docs/internals/alpha.md.
[[nodiscard]] AlphaRule default_rule(const AlphaTables& tables, bool noise_known) noexcept;

/// The rule whose alpha sizes the prior of bands: evidence where the stated noise is relied on,
/// else gml, which also holds if the noise is another. The alphas of other rules make good
/// tractions and too small a prior (docs/internals/decisions.md).
[[nodiscard]] constexpr AlphaRule prior_rule(bool relies_on_noise) noexcept {
  return relies_on_noise ? AlphaRule::evidence : AlphaRule::gml;
}

/// `sweep_alpha` and `choose_alone` by tables made once; the answers are the same to rounding.
///
/// @throw std::invalid_argument  as without tables; gamma or rows of the frame are not the tables'
[[nodiscard]] AlphaSweep sweep_alpha(const FilterFrame& frame, const AlphaTables& tables,
                                     std::optional<double> noise_rms = {});
[[nodiscard]] AlphaChoice choose_alone(const FilterFrame& frame, const AlphaTables& tables,
                                       AlphaRule rule, std::optional<double> noise_rms = {});

}  // namespace tactile_net
