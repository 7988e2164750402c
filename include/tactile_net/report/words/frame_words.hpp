/// @file
/// What is said of one frame of a recording, of a line's and of a skin's.
#pragma once

#include <string>

#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/run.hpp"

namespace tactile_net::report {

struct FrameWords {
  std::string place{};   ///< "frame 160 of 241, t = 0.8 s"
  std::string answer{};  ///< "normal force 20.2 ± 0.2 N/m, centre 0.35 ± 0.02 mm; alpha 1e-3"
  std::string trust{};   ///< why it cannot be trusted; empty: it can
};

[[nodiscard]] FrameWords frame_words(const lab::RecordingOverview& overview,
                                     const lab::FrameGroup& group);

/// Of a skin's frame that is no recording's: its place stays empty.
/// @pre  the first result has an answer
[[nodiscard]] FrameWords frame_words(const lab::Experiment& experiment);

}  // namespace tactile_net::report
