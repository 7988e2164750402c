/// @file
/// What a user should know of an answer, a sentence each.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/remark.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"

namespace tactile_net::report {

/// "rounding alone may have moved the answer by 0.002 of its size; raise alpha"
[[nodiscard]] std::string in_words(const lab::Remark& remark);

[[nodiscard]] std::vector<std::string> in_words(const lab::Remarks& remarks);

/// "stress_x 12 kPa, strain_x 3e-5"; without units the numbers alone.
[[nodiscard]] std::string in_words(const lab::remark::OffsetsFound& offsets);

/// "2.5 % of the normal force lies beyond the ends of the array"
[[nodiscard]] std::string in_words(const lab::SceneRemark& remark);

/// All that is to be said of a scene's readings.
[[nodiscard]] std::vector<std::string> in_words(const lab::SimulatedFrame& frame);
[[nodiscard]] std::vector<std::string> in_words(const lab::SkinFrame& frame);

}  // namespace tactile_net::report
