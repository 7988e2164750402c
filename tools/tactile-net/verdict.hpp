/// @file
/// A survey in plain words: what cannot be told, why, and what to read instead.
#pragma once

#include <string>
#include <vector>

#include "survey.hpp"

namespace tactile_net::tool {

/// Sentences, the verdict itself first.
[[nodiscard]] std::vector<std::string> verdict_in_words(const Survey& survey, const Scene& scene);

}  // namespace tactile_net::tool
