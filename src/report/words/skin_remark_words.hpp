/// @file
/// What is to be said of a skin's answers beside the numbers. Private.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/skin_recording.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::report {

/// What an answer without dense matrices has not.
/// @pre  it has been solved by products
[[nodiscard]] std::string without_matrix(const lab::FrameAnswer& answer);

/// Which frames miss readings, and what became of them.
void add_missing(std::vector<Answer>& all, const lab::SkinRecordingAnswer& recording);

}  // namespace tactile_net::report
