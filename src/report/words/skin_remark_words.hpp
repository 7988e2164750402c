/// @file
/// What is said of a skin's answers. Private.
#pragma once

#include <string>

#include "tactile_net/lab/answer.hpp"

namespace tactile_net::report {

/// Of a run: how hard, how it is dragged, where, how near to slipping, and how far from the truth.
[[nodiscard]] std::vector<Answer> skin_answers(const lab::Experiment& experiment);

}  // namespace tactile_net::report
