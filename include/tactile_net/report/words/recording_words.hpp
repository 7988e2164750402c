/// @file
/// A recording in words: what a page says first, and of each frame.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tactile_net/lab/recording.hpp"
#include "tactile_net/report/words/answers.hpp"

namespace tactile_net::report {

/// How hard, how it was dragged, where, what not to trust, and whether the readings are suspicious.
[[nodiscard]] std::vector<Answer> answers(const lab::RecordingOverview& overview);

/// How many frames miss readings, and what became of them.
[[nodiscard]] std::vector<Answer> missing_answers(const lab::RecordingOverview& overview);

/// "241 frames, 1.2 s, 41 taxels, ..."
[[nodiscard]] std::string recording_in_words(const lab::RecordingOverview& overview);

/// "frame 160, t = 0.8", "frames 16 to 31, frame 20 shown"
[[nodiscard]] std::string group_place(const lab::RecordingOverview& overview,
                                      const lab::FrameGroup& group);

/// "0.8 s", to the millisecond even since 1970; "frame 7" where the frame has no time.
[[nodiscard]] std::string clock_in_words(double seconds, std::size_t frame);

/// The same of the frame that stands for a group.
[[nodiscard]] std::string group_clock(const lab::FrameGroup& group);

/// "force 2.0 ± 0.1 N, centre y 0.3 ± 0.1 mm, z ...; alpha 1e-3", of a skin's frame
[[nodiscard]] std::string wrench_in_words(const lab::FrameAnswer& answer, const SkinScene& scene);

/// "normal force 20.2 ± 0.2, tangential 7.1 ± 0.1, centre 0.35 ± 0.02; alpha 1e-3"
[[nodiscard]] std::string group_answer(const lab::RecordingOverview& overview,
                                       const lab::FrameGroup& group);

/// "unstable: the answer depends on alpha ...", and what is doubtful about the readings; empty:
/// nothing
[[nodiscard]] std::string distrust_in_words(const lab::FrameAnswer& answer, const AnyScene& scene);

/// A sentence for every verdict but ok, and every doubt of the readings, with the number of frames.
[[nodiscard]] std::vector<std::string> distrusted_in_words(const lab::RecordingOverview& overview);

}  // namespace tactile_net::report
