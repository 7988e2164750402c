/// @file
/// From what a rule minimises to its alpha and a verdict. Private.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "inverse/alpha_criteria.hpp"

namespace tactile_net {

/// One rule's answer before the others are heard.
struct FoundAlpha {
  double log_alpha = 0.0;
  AlphaVerdict verdict = AlphaVerdict::ok;
};

/// What a rule chooses: the least of its values, or their crossing of zero for discrepancy, refined
/// to a root of `zero`.
///
/// The least is sought between the smallest and the largest gamma first, and from an end of that
/// on only downhill: beyond, GCV and its kin are flat, and a dip of theirs there means nothing.
///
/// @param values  as `Criteria::values`, of one frame or summed over several
/// @param zero    as `Criteria::zero`, likewise
[[nodiscard]] FoundAlpha search(const AlphaTables::Parts& tables, AlphaRule rule,
                                std::span<const double> values,
                                const std::function<double(double)>& zero);

/// The choice where there is no signal: so much smoothing that the answer vanishes.
[[nodiscard]] FoundAlpha nothing_to_choose(const AlphaTables::Parts& tables);

/// True if the rule's answer counts: it knows the noise, or there are readings to guess it by.
[[nodiscard]] inline bool trusted(const AlphaTables::Parts& tables, AlphaRule rule) noexcept {
  return needs_noise(rule) || !tables.cannot_estimate_noise;
}

/// The verdict on one candidate among all: the rule can tell noise from signal, ten times alpha
/// would not give another traction, and that differs by at most half from the one of the others'
/// median alpha.
///
/// @param others  log alpha of the other trusted rules' candidates; empty: they are not heard
[[nodiscard]] AlphaVerdict judge(const Criteria& criteria, const AlphaTables::Parts& tables,
                                 AlphaRule rule, const FoundAlpha& one, std::vector<double> others);

/// Whether the rule needs the noise's rms, or a periodogram, and has not got it.
[[nodiscard]] bool lacks_noise(AlphaRule rule, std::optional<double> noise_rms) noexcept;
[[nodiscard]] bool lacks_periodogram(AlphaRule rule, const FilterFrame& frame) noexcept;

/// @throw std::invalid_argument  as `lacks_noise`, `lacks_periodogram`
void require_noise(AlphaRule rule, std::optional<double> noise_rms);
void require_periodogram(AlphaRule rule, const FilterFrame& frame);

}  // namespace tactile_net
