/// @file
/// What a calibration doubts of its log, in sentences. Private.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/calibrate.hpp"

namespace tactile_net::report {

/// Stated values that readings contradict or that were put aside, gains that no sound taxel has,
/// residuals that go with the order of the presses.
[[nodiscard]] std::vector<std::string> doubts_in_words(const lab::SceneCalibration& found);

}  // namespace tactile_net::report
