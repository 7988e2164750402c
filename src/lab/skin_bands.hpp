/// @file
/// How far a skin's tractions may be off, the cells that touch, and what these amount to. Private.
#pragma once

#include <cstddef>
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

[[nodiscard]] double sum_over(std::span<const double> values, std::span<const std::size_t> cells);

/// Adds what the tractions of some cells of a curved skin amount to in the sensor's own axes.
/// Nothing of a flat one's.
///
/// @param wrench  of them on the chart, with all its doubts
void add_space(UncertainWrench& wrench, const SkinSceneProblem& problem,
               std::span<const double> tractions, std::span<const std::size_t> cells,
               const Covariance& covariance, double noise_rms);

/// The variance of place that smoothing may have added to pressure: of a rectangle that stands for
/// one degree of freedom of it [m^2].
[[nodiscard]] double smoothed_variance(const SkinSceneProblem& problem, double degrees_of_freedom);

/// How far apart a skin's taxels lie, in depths.
[[nodiscard]] double pitch_in_depths(const SkinArray& skin);

}  // namespace tactile_net::lab
