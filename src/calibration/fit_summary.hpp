/// @file
/// What a fit knows: covariance, verdicts, residuals. Private.
#pragma once

#include "calibration/fit_problem.hpp"
#include "calibration/levenberg_marquardt.hpp"
#include "tactile_net/calibration/press_fit.hpp"

namespace tactile_net {

/// @param stated  the options before parameters that cannot be known were held
void summarise(const FitProblem& problem, const Descent& best, const CalibrationOptions& stated,
               PressFit& fit);

}  // namespace tactile_net
