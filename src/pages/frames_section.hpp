/// @file
/// Private. The frames of a recording, or one frame, on a page: places for the pictures that
/// web/frames.js draws of the data, and a table of the same in words.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/skin_recording.hpp"
#include "tactile_net/lab/skin_run.hpp"

namespace tactile_net::pages {

/// @pre  there is a frame
[[nodiscard]] std::string frames_section(const lab::RecordingOverview& overview);

/// @pre  a frame is shown
[[nodiscard]] std::string frames_section(const lab::SkinRecordingAnswer& recording);

/// @pre  there is an answer or a truth
[[nodiscard]] std::string frames_section(const lab::SkinExperiment& experiment);

}  // namespace tactile_net::pages
