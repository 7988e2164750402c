/// @file
/// What can be seen of a log before anything is fitted. Private.
#pragma once

#include "calibration/fit_problem.hpp"

namespace tactile_net {

/// Signs, units and directions that no calibration mends: a fit would run away with them.
///
/// @throw std::invalid_argument  most presses read with the other sign than the model; readings a
///                               thousand times too large for the stated forces, or too small;
///                               positions that run against the array, or in other units than it
void require_plausible(const FitProblem& problem);

}  // namespace tactile_net
