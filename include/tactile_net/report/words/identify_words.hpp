/// @file
/// A survey in plain words: what cannot be told, why, and what to read instead.
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

}  // namespace tactile_net::report
