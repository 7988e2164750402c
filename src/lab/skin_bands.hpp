/// @file
/// How far a skin's tractions may be off, the cells that touch, and what these amount to. Private.
#pragma once

#include <optional>
#include <span>

#include "lab/skin_method.hpp"
#include "tactile_net/lab/answer.hpp"

namespace tactile_net::lab {

/// Bands, the cells that touch, and what the tractions amount to. Under constraints the contacts
/// are judged by what these leave free; the bands of cells are those without constraints, which
/// hold what the constraints have moved.
///
/// @param face  what constraints leave free; absent: there are none, or they leave nothing
void add_bands(FrameAnswer& answer, const SkinSceneProblem& problem, const SkinMethod& method,
               const FilterFrame& frame, const std::optional<TikhonovFamily>& face,
               std::span<const double> readings);

/// Taxels that lie further apart than this, in depths, hardly see what presses between them: what
/// constraints hold there is not certain, and no deviation holds a force under them.
inline constexpr double far_apart = 1.75;

/// How far apart a skin's taxels lie, in depths.
[[nodiscard]] double pitch_in_depths(const SkinArray& skin);

}  // namespace tactile_net::lab
