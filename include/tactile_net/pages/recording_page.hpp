/// @file
/// The page of a recording: the answer, the pad and one frame of it, everything over time.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/recording.hpp"
#include "tactile_net/pages/made.hpp"

namespace tactile_net::pages {

/// One file, without a network; a byte or two for each of the values that are shown. A recording
/// without frames is a page that says so. Of a skin with all of the frame that presses hardest, and
/// that one's files.
///
/// @param notes  what else is to be said: remarks of the method, columns that were not read
[[nodiscard]] drawing::Page recording_page(const lab::RecordingOverview& overview,
                                           const std::string& readings,
                                           const std::vector<std::string>& notes, const Made& made);

}  // namespace tactile_net::pages
