/// @file
/// The report of `run` for a skin: maps of what presses and drags, found and true, how far they
/// may be off, sections through the peak, the pad, what the taxels read.
#pragma once

#include <string>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/skin_recording.hpp"
#include "tactile_net/lab/skin_run.hpp"
#include "tactile_net/pages/made.hpp"

namespace tactile_net::pages {

/// With the files beside it. @param by  the command that made it; empty: not said
[[nodiscard]] drawing::Page run_page(const lab::SkinExperiment& experiment, const std::string& by);

/// The page of a recording: every frame's forces, and all of the frame that presses hardest.
///
/// @param readings  the recording's name
/// @pre  there is a frame
[[nodiscard]] drawing::Page recording_page(const lab::SkinRecordingAnswer& recording,
                                           const std::string& readings, const Made& made);

}  // namespace tactile_net::pages
