/// @file
/// How much heavier the stabiliser of a skin's tangential tractions should be than the normal
/// one's: as inverse/tangential_weight.hpp, of which it asks the readings.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// The one of `tangential_weights` with the least -log posterior, searched from 1 upwards or
/// downwards as long as that helps: some six are tried.
///
/// @param negative_log_posterior  of a weight: `negative_log_evidence` of the frame under it, plus
///                                `negative_log_prior`
[[nodiscard]] double likeliest_tangential_weight(
    const std::function<double(double weight)>& negative_log_posterior);

/// The likeliest of `tangential_weights` for a frame, each tried with a `SkinFamily` of its own; 1
/// with one component, or if nothing was read.
///
/// @param noise_rms  of one weighted reading, > 0; absent: not known
/// @throw std::invalid_argument  readings have the wrong size or are not finite, or noise_rms is
///                               not > 0
[[nodiscard]] double likeliest_tangential_weight(SkinProblem problem,
                                                 std::span<const double> readings,
                                                 std::optional<double> noise_rms = {});

}  // namespace tactile_net
