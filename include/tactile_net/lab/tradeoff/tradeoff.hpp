/// @file
/// A scene's work-precision study: every method, timed on this machine, beside the exact answer.
///
///     const lab::Study study = lab::tradeoff(scene, {.circuits = false});
///     const std::vector<lab::WorkPoint> points = study.points();
///     const auto front = lab::pareto_front(points, &lab::WorkPoint::error_to_solution,
///                                          lab::TimeOf::frame);
#pragma once

#include <vector>

#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/lab/tradeoff/runner.hpp"
#include "tactile_net/lab/tradeoff/study.hpp"
#include "tactile_net/lab/tradeoff/work_precision.hpp"

namespace tactile_net::lab {

struct TradeoffOptions {
  bool circuits = true;  ///< false: arithmetic only, no simulator
  SimulatorChoice simulator{.time_limit = 60.0};
  std::vector<StudySection> finished{};  ///< of an earlier study of this scene on this processor
  Clock clock = monotonic_time;
};

/// Watches nothing: the default of `tradeoff`.
inline StudyObserver silent_study;

/// Takes about a minute for 81 taxels, most of it in the simulator. A method that fails is a point
/// with its failure; where `observer` stops the study, it is not `complete`.
///
/// @throw std::invalid_argument  the scene cannot be studied, see `study_input`; the simulator's
///                               options are wrong
/// @throw SimulatorError         circuits are asked for and the simulator does not work
[[nodiscard]] Study tradeoff(const Scene& scene, const TradeoffOptions& options = {},
                             StudyObserver& observer = silent_study);

}  // namespace tactile_net::lab
