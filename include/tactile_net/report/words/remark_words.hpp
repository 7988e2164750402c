/// @file
/// What a user should know of an answer, a sentence each.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/lab/remark.hpp"
#include "tactile_net/lab/simulated_frame.hpp"

namespace tactile_net::lab {
struct FrameAnswer;
}

namespace tactile_net::report {

/// What is said beside an answer's numbers, a sentence each.
struct Sentences {
  std::vector<std::string> warnings{};  ///< what to know before the answer is trusted
  std::vector<std::string> notes{};     ///< what was found beside it, in the normal course

  /// The warnings, then the notes.
  [[nodiscard]] std::vector<std::string> all() const;
};

/// "rounding alone may have moved the answer by 0.002 of its size; raise alpha"
[[nodiscard]] std::string in_words(const lab::Remark& remark);

/// Whether it says what was found in the normal course, as a weight or offsets that the scene asks
/// for: no reason to doubt the answer.
[[nodiscard]] bool is_note(const lab::Remark& remark);

[[nodiscard]] std::vector<std::string> in_words(const lab::Remarks& remarks);

[[nodiscard]] Sentences warnings_and_notes(const lab::Remarks& remarks);

/// All that is to be said of an answer, of a line or a skin.
[[nodiscard]] Sentences remarks_in_words(const lab::FrameAnswer& answer);

/// A line each: "warning: ..." and "note: ...", behind what stands before.
void print_remarks(std::ostream& out, std::string_view before, const Sentences& said);

/// "stress_x 12 kPa, strain_x 3e-5"; without units the numbers alone.
[[nodiscard]] std::string in_words(const lab::remark::OffsetsFound& offsets);

/// "2.5 % of the normal force lies beyond the ends of the array"
[[nodiscard]] std::string in_words(const lab::SceneRemark& remark);

/// All that is to be said of a scene's readings.
[[nodiscard]] std::vector<std::string> in_words(const lab::SimulatedFrame& frame);

}  // namespace tactile_net::report
