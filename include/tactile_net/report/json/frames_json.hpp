/// @file
/// What the script of a page (pages/web/frames.js) draws frames from: tractions, their bands, the
/// truth, readings, forces over time, and what is said of each frame; of lines and skins alike.
#pragma once

#include <string>

#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/skin_recording.hpp"
#include "tactile_net/lab/skin_run.hpp"

namespace tactile_net::report {

/// @pre  there is a frame
[[nodiscard]] std::string frames_json(const lab::RecordingOverview& overview);

/// @pre  a frame is shown
[[nodiscard]] std::string frames_json(const lab::SkinRecordingAnswer& recording);

/// One frame: its answer beside the truth, or without an answer the truth alone.
/// @pre  there is an answer or a truth
[[nodiscard]] std::string frames_json(const lab::SkinExperiment& experiment);

}  // namespace tactile_net::report
