/// @file
/// A scene's work-precision study: every method, timed on this machine, beside the exact answer.
///
///     const study::Study study = study::tradeoff(scene, {.circuits = false});
///     const std::vector<study::WorkPoint> points = study.points();
///     const auto front = study::pareto_front(points, &study::WorkPoint::error_to_solution,
///                                          study::TimeOf::frame);
#pragma once

#include <vector>

#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/study/runner.hpp"
#include "tactile_net/study/study.hpp"
#include "tactile_net/study/work_precision.hpp"

namespace tactile_net::study {

struct TradeoffOptions {
  bool circuits = true;  ///< false: arithmetic only, no simulator
  lab::SimulatorChoice simulator{.time_limit = 60.0};
  std::vector<StudySection> finished{};  ///< of an earlier study of this scene on this processor
  lab::Clock clock = lab::monotonic_time;
};

/// Watches nothing: the default of `tradeoff`.
inline StudyObserver silent_study;

/// Takes about a minute for 81 taxels, most of it in the simulator. A method that fails is a point
/// with its failure; where `observer` stops the study, it is not `complete`.
///
/// @throw std::invalid_argument  the scene cannot be studied, see `study_input`; the simulator's
///                               options are wrong
/// @throw SimulatorError         circuits are asked for and the simulator does not work
[[nodiscard]] Study tradeoff(const AnyScene& scene, const TradeoffOptions& options = {},
                             StudyObserver& observer = silent_study);

}  // namespace tactile_net::study
