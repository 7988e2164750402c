/// @file
/// A controller's plan in words.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "tactile_net/lab/planned_controller.hpp"

namespace tactile_net::report {

/// "given", "rgcv, the median of 70 frames", "rgcv, on the scene's own contact"
[[nodiscard]] std::string in_words(const lab::PlanAlpha& alpha);

/// The choice, what spoke against the others, and what a frame takes.
///
/// @param frame_seconds  measured on this machine
/// @param deadline       [s], that a frame must meet
void print_controller(std::ostream& out, const lab::PlannedController& planned,
                      double frame_seconds, std::optional<double> deadline);

/// Why the deadline is missed, and what helps.
[[nodiscard]] std::string deadline_missed_in_words(const lab::PlannedController& planned,
                                                   double frame_seconds, double deadline);

}  // namespace tactile_net::report
