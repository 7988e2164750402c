/// @file
/// What a user should know of a recording as a whole.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/summary.hpp"
#include "tactile_net/scene/any_scene.hpp"

namespace tactile_net::report {

/// "frame 17", "frames 17, 40-43", of many the first.
[[nodiscard]] std::string in_words(const lab::FrameRuns& frames);

/// "5 of 70 frames have the verdict border: frames 17, 40-43": one for each that is not ok; how
/// many were skipped or estimated; and that drag counts as none, where pressure alone is solved for
/// and no contact of the scene says that there is none.
[[nodiscard]] std::vector<std::string> in_words(const lab::SolvedFrames& solved,
                                                const AnyScene& scene);

/// "saturation cuts readings off in 3 of 11 frames": one for each effect that does.
[[nodiscard]] std::vector<std::string> in_words(const lab::RecordedFrames& recorded);

}  // namespace tactile_net::report
