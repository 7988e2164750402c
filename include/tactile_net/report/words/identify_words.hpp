/// @file
/// A survey in plain words: what cannot be told, why, and what to read instead.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/identify.hpp"

namespace tactile_net::report {

/// Sentences, the verdict itself first.
[[nodiscard]] std::vector<std::string> verdict_in_words(const lab::Survey& survey,
                                                        const Scene& scene);

}  // namespace tactile_net::report
