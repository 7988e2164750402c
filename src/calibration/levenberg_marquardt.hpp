/// @file
/// The iteration: Levenberg-Marquardt with bounds by projection. Private.
///
/// Eigen's unsupported one (MINPACK's) takes the whole Jacobian at once, whose QR costs the square
/// of the presses' unknowns; here these are eliminated press by press (fit_system.hpp), so that
/// time grows with the presses alone.
#pragma once

#include <cstddef>
#include <optional>

#include "calibration/fit_problem.hpp"
#include "calibration/fit_system.hpp"

namespace tactile_net {

struct Descent {
  FitState state{};
  double objective = 0.0;
  std::size_t iterations = 0;
  bool converged = false;
};

/// At most four tries a step: a fit of a log that is not of its scene is to end, too.
///
/// @param held   a pad parameter that stays where it is
/// @param known  an objective that another start reached: close to it, this one is done
[[nodiscard]] Descent descend(const FitProblem& problem, FitState state,
                              std::optional<PadParameter> held = {}, double known = 0.0);

/// The bounds that are active at a state, as the system takes them.
[[nodiscard]] SystemParts active_bounds(const FitProblem& problem, const FitState& state,
                                        const SystemColumns& columns);

}  // namespace tactile_net
