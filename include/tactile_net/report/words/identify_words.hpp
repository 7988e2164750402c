/// @file
/// A survey in plain words: what cannot be told, why, what to read instead, and how all compare.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/lab/identify.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net::report {

/// "stress_x, shear_xy at 1.5"
[[nodiscard]] std::string in_words(const lab::SensorChoice& choice,
                                   const std::optional<Units>& units = {});

/// "1 % of the largest reading that a ripple of that normal traction causes"
[[nodiscard]] std::string in_words(const lab::AssumedNoise& noise);

/// "Dead taxels read nothing: what only they would show is lost."
[[nodiscard]] std::string in_words(const lab::HiddenReason& reason,
                                   const std::optional<Units>& units = {});

/// Sentences, the verdict itself first.
[[nodiscard]] std::vector<std::string> verdict_in_words(const lab::Survey& survey,
                                                        const std::optional<Units>& units = {});

/// Header and rows of the comparison, the scene's own sensors first.
[[nodiscard]] std::vector<std::vector<std::string>> survey_cells(
    const lab::Survey& survey, const std::optional<Units>& units = {});

/// How to read those cells.
[[nodiscard]] std::string cells_in_words(const Scene& scene, const lab::Survey& survey);

/// What the singular values of the scene's sensors say, one sentence each.
[[nodiscard]] std::vector<std::string> singular_values_in_words(
    const Identifiability& result, const std::optional<Units>& units = {});

}  // namespace tactile_net::report
