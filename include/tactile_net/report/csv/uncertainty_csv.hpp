/// @file
/// A frame's tractions, and how far it may be from the truth, as rows of files of frames.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/answer.hpp"

namespace tactile_net::report {

/// Of every traction: "normal_3" of a line, of a skin "normal_3_5".
[[nodiscard]] std::vector<std::string> traction_columns(const lab::AnyProblem& problem);

/// Of a line forces, centre and angle, each with its deviation, the misfit, the deviation of every
/// traction, where answers are mixtures the ends of all intervals beside deviations (`_low`,
/// `_high`), the offset of every channel where these are not known, the worst doubt about the
/// readings (`data`: 0 none, else 1 + DataDoubt), alpha, and the verdict, which is a word. Of a
/// skin as skin_csv.hpp has it.
[[nodiscard]] std::vector<std::string> uncertainty_columns(const lab::AnyProblem& problem);

/// The values of those columns but the last; NaN: not known.
/// @pre  the answer has its bands
[[nodiscard]] std::vector<double> uncertainty_values(const lab::AnyProblem& problem,
                                                     const lab::FrameAnswer& answer);

}  // namespace tactile_net::report
