/// @file
/// The loop of a controller: a plan made before it, and a call for each frame, which allocates
/// nothing and throws nothing.
///
///     const PlannedEstimator planned = plan_estimator(problem, alpha, {.accuracy = 1e-7});
///     ContactEstimator estimator(planned.plan);
///     std::vector<double> tractions(estimator.tractions());
///     ContactEstimate contact{.tractions = tractions};
///     const FrameStatus status = estimator.update(readings, contact, time);
///
/// Who only runs plans links `tactile_net::rt` and includes realtime/contact_estimator.hpp.
#pragma once

#include "tactile_net/control/planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/handover.hpp"
#include "tactile_net/realtime/plan_file.hpp"
