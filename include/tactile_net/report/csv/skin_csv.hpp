/// @file
/// What was found on a skin, as CSV.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tactile_net/lab/answer.hpp"

namespace tactile_net::report {

/// Of every cell, "normal_3_5" of row 3 and column 5, component after component.
[[nodiscard]] std::vector<std::string> traction_columns(const SurfaceGrid& grid,
                                                        std::size_t components);

/// What one frame amounts to, each value with its deviation; NaN where there is none: forces,
/// centre, torsion, friction, the angle of the force to the normal [rad], and what is left of the
/// friction limit.
/// @param intervals  whether the ends of each one's interval stand behind its deviation
/// @param curved     with force, moment and centre in the sensor's own axes
[[nodiscard]] std::vector<std::string> resultant_columns(bool intervals = false,
                                                         bool curved = false);
[[nodiscard]] std::vector<double> resultant_values(const lab::FrameAnswer& answer,
                                                   bool intervals = false, bool curved = false);

/// Of `solve --uncertainty`: those, then the constant found in each channel where offsets are not
/// known, whether the readings can be true (0, or 1 + the worst `DataDoubt`), and alpha, all in SI
/// units where the scene has [units]; last the verdict, a word.
[[nodiscard]] std::vector<std::string> uncertainty_columns(const lab::SkinSceneProblem& problem);
/// Of all columns but the last.
[[nodiscard]] std::vector<double> uncertainty_values(const lab::SkinSceneProblem& problem,
                                                     const lab::FrameAnswer& answer);

}  // namespace tactile_net::report
