/// @file
/// How far a frame may be from the truth, as a row of a file of frames.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/uncertainty.hpp"

namespace tactile_net::report {

/// Forces, centre and angle, each with its deviation, the misfit, the deviation of every traction,
/// the offset of every channel where these are not known, the worst doubt about the readings
/// (`data`: 0 none, else 1 + DataDoubt), alpha, and the verdict, which is a word.
[[nodiscard]] std::vector<std::string> uncertainty_columns(const lab::SceneProblem& problem);

/// The values of those columns but the last; NaN: not known.
[[nodiscard]] std::vector<double> uncertainty_values(const lab::FrameUncertainty& uncertainty,
                                                     const std::optional<DataVerdict>& data,
                                                     double alpha);

}  // namespace tactile_net::report
