/// @file
/// Where the log, the scene and the fit contradict each other. Private.
#pragma once

#include <optional>

#include "calibration/fit_problem.hpp"
#include "tactile_net/calibration/press_fit.hpp"

namespace tactile_net {

/// Standard deviations beyond which a reading, or what is stated of one press, stands out.
inline constexpr double outlying = 5.0;

/// What is stated of a press that its readings contradict: the value that moved more than 5 of its
/// sds; else, where more than three readings are off, the one whose change explains them best.
///
/// @param readings  of the state
[[nodiscard]] std::optional<ContradictedPress> contradiction(const FitProblem& problem,
                                                             const FitState& state,
                                                             const PressReadings& readings,
                                                             std::size_t press);

/// Fills in what is contradicted and how residuals go with time, and calls the fit poor where it
/// is. After `summarise`.
///
/// @param stated  the options before parameters that cannot be known were held
void doubt(const FitProblem& problem, const FitState& state, const CalibrationOptions& stated,
           PressFit& fit);

}  // namespace tactile_net
