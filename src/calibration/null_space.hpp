/// @file
/// What no reading of a log changes with. Private.
#pragma once

#include <vector>

#include "calibration/fit_problem.hpp"
#include "tactile_net/calibration/press_fit.hpp"

namespace tactile_net {

/// In this order a parameter is held where several cannot be told apart: first what matters least.
inline constexpr PadParameter held_first[] = {
    PadParameter::shift,     PadParameter::shift_z,        PadParameter::pitch,
    PadParameter::crosstalk, PadParameter::youngs_modulus, PadParameter::poisson_ratio,
    PadParameter::thickness, PadParameter::depth};

/// Directions of the common unknowns whose singular value is below 1e-8 of the largest, columns
/// scaled, no priors but what is stated of presses and measured unloaded.
[[nodiscard]] std::vector<NullDirection> null_directions(const FitProblem& problem,
                                                         const FitState& state);

/// Whether a pad parameter has a part in one of them.
[[nodiscard]] bool takes_part(const std::vector<NullDirection>& directions, PadParameter parameter);

}  // namespace tactile_net
