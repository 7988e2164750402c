/// @file
/// A survey in plain words: what cannot be told, why, and what to read instead.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/identify.hpp"

namespace tactile_net::report {

/// "stress_x, shear_xy at 1.5"
[[nodiscard]] std::string in_words(const lab::SensorChoice& choice);

/// "1 % of the largest reading that a ripple of that normal traction causes"
[[nodiscard]] std::string in_words(const lab::AssumedNoise& noise);

/// "Dead taxels read nothing: what only they would show is lost."
[[nodiscard]] std::string in_words(const lab::HiddenReason& reason);

/// Sentences, the verdict itself first.
[[nodiscard]] std::vector<std::string> verdict_in_words(const lab::Survey& survey);

}  // namespace tactile_net::report
