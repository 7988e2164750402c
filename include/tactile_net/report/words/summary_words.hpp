/// @file
/// What a user should know of a recording as a whole.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/summary.hpp"

namespace tactile_net::report {

/// "3 of 70 frames have the verdict border": one for each that is not ok.
[[nodiscard]] std::vector<std::string> in_words(const lab::SolvedFrames& solved);

/// "saturation cuts readings off in 3 of 11 frames": one for each effect that does.
[[nodiscard]] std::vector<std::string> in_words(const lab::RecordedFrames& recorded);

}  // namespace tactile_net::report
