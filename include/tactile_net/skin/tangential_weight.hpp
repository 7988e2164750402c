/// @file
/// How much heavier the stabiliser of a skin's tangential tractions should be than the normal
/// one's: as inverse/tangential_weight.hpp, of which it asks the readings.
#pragma once

#include <optional>
#include <span>

#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// The one of `tangential_weights` under which a frame is likeliest; 1 with one component, or where
/// nothing was read. Some six `SkinFamily` from 1 upwards or downwards, as long as that helps.
///
/// @param noise_rms  of one weighted reading, > 0; absent: not known
/// @throw std::invalid_argument  readings have the wrong size or are not finite; noise_rms is not >
/// 0
[[nodiscard]] double likeliest_tangential_weight(SkinProblem problem,
                                                 std::span<const double> readings,
                                                 std::optional<double> noise_rms = {});

}  // namespace tactile_net
