/// @file
/// How far a frame may be from the truth, as a row of a file of frames.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tactile_net/lab/uncertainty.hpp"

namespace tactile_net::report {

/// Forces, centre and angle, each with its deviation, the misfit, the deviation of every traction,
/// alpha, the verdict and the data's, which are words.
[[nodiscard]] std::vector<std::string> uncertainty_columns(std::size_t count, bool with_tangential);

/// The values of those columns but the last two; NaN: not known.
[[nodiscard]] std::vector<double> uncertainty_values(const lab::FrameUncertainty& uncertainty,
                                                     double alpha);

}  // namespace tactile_net::report
