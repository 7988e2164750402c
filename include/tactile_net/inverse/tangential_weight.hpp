/// @file
/// How much heavier the tangential traction's stabiliser should be than the normal one's.
///
/// The functional of linear_problem.hpp takes the tangential traction for `tangential_weight` times
/// smaller than the normal one. Nobody knows by how much before something drags, and readings that
/// hardly tell the two tractions apart answer a press with a drag where the weight is 1. The
/// readings know: of two weights that is better under which they are more likely, each with the
/// alpha that suits it best (MacKay 1992; two weights of one functional: Brezinski and others
/// 2003).
///
///     const double weight = likeliest_tangential_weight(problem, readings, noise_rms);
///
/// For many frames, with a family of each weight made once:
///
///     double best = 1.0, least = infinity;
///     for (const double weight : tangential_weights) {
///       const TikhonovFamily& family = of(weight);
///       const FilterFrame frame = family.analyse(readings);
///       const double value = negative_log_evidence(frame, tables(weight), noise_rms) +
///                            negative_log_prior(weight);
///       if (value < least) least = value, best = weight;
///     }
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>

#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// The weights to try, those nearer to 1 first, sqrt(2) apart: from a drag four times as large as
/// the press to none. The readings of a frame do not tell the weight more finely.
// clang-format off
inline constexpr std::array tangential_weights = {
    1.0, 1.4142135623730951, 0.70710678118654752, 2.0, 0.5, 2.8284271247461903, 0.35355339059327376,
    4.0, 0.25, 5.6568542494923806, 8.0, 11.313708498984761, 16.0, 22.627416997969522, 32.0,
    45.254833995939045, 64.0};
// clang-format on

/// -log of the prior of a weight w, less that of 1: a half-Cauchy density of 1/w, over log w
/// (Gelman 2006; Polson and Scott 2012). >= 0. It keeps frames that say nothing of the tangential
/// traction from saying that there is none.
///
/// @param tangential_weight  w, > 0
[[nodiscard]] double negative_log_prior(double tangential_weight) noexcept;

/// -log p(g) of a frame g, but for a constant: the minimum over alpha of what the rule evidence
/// minimises; without the noise's rms, of what gml minimises, which profiles the rms out. Of
/// families that differ in the weight alone the one with the least value suits the frame best. 0 if
/// nothing was read.
///
/// @param tables     of the frame's family
/// @param noise_rms  of one weighted reading, > 0; absent: not known
/// @param alpha      > 0: the value at this alpha; absent: the minimum over alpha
/// @throw std::invalid_argument  the tables are of another family; noise_rms is not > 0
[[nodiscard]] double negative_log_evidence(const FilterFrame& frame, const AlphaTables& tables,
                                           std::optional<double> noise_rms = {},
                                           std::optional<double> alpha = {});

/// The one of `tangential_weights` with the least -log posterior, searched from 1 upwards or
/// downwards as long as that helps: some six are tried.
///
/// @param negative_log_posterior  of a weight: `negative_log_evidence` of the frame under it, plus
///                                `negative_log_prior`
[[nodiscard]] double likeliest_tangential_weight(
    const std::function<double(double weight)>& negative_log_posterior);

/// The likeliest of `tangential_weights` for a frame, each tried with a family of its own; 1 with
/// one component, or if nothing was read.
///
/// @param noise_rms  of one weighted reading, > 0; absent: not known
/// @throw std::invalid_argument  readings have the wrong size or are not finite; noise_rms is not
///                               > 0
[[nodiscard]] double likeliest_tangential_weight(LinearProblem problem,
                                                 std::span<const double> readings,
                                                 std::optional<double> noise_rms = {});

}  // namespace tactile_net
