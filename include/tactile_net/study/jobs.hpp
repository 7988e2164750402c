/// @file
/// The work of a study, job by job.
#pragma once

#include <functional>
#include <vector>

#include "tactile_net/lab/simulator_choice.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::study {

struct StudyJob {
  Job job{};
  double weight = 1.0;  ///< about how long it takes [s], for the remaining time
  bool timed = true;    ///< its arithmetic is timed: nothing else may run meanwhile
  std::function<StudySection()> run{};
};

/// The arithmetic: one job per family of methods. A family that throws is a point that says so.
///
/// @param input  must outlive the jobs
/// @param clock  [s], see stopwatch.hpp
[[nodiscard]] std::vector<StudyJob> digital_jobs(const StudyInput& input, const lab::Clock& clock);

/// The circuits: settling in the simulator, accuracy of parts, and what the simulator itself takes.
/// Each job makes a simulator of its own: they may run side by side.
///
/// @param input  must outlive the jobs
/// @param stop   asked by every job, from its own thread: true ends the work with what there is
[[nodiscard]] std::vector<StudyJob> circuit_jobs(const StudyInput& input,
                                                 const lab::SimulatorChoice& choice,
                                                 const std::function<bool()>& stop);

}  // namespace tactile_net::study
