/// @file
/// Runs a study's jobs, goes on with an earlier study, and says how far it is.
#pragma once

#include <optional>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/study/jobs.hpp"

namespace tactile_net::study {

/// How far a study is.
struct StudyProgress {
  Job job{};                             ///< the one begun last
  double share = 0.0;                    ///< of the work that is done, 0 ... 1
  std::optional<double> seconds_left{};  ///< at the pace so far; absent: no job is done yet
  bool stopping = false;                 ///< only what has begun is finished
};

/// `stop` is asked from several threads at once, and by jobs while they work.
class StudyObserver : public lab::Observer {
 public:
  /// About five times a second, on the thread that called.
  virtual void progress(const StudyProgress& /*progress*/) {}
  /// After each job, on the thread that has done it, one at a time: the study so far, `complete` or
  /// not. What this throws ends the study as `stop` does, and is thrown on.
  virtual void save(const Study& /*study*/) {}
};

/// Runs the jobs into `study.sections`, which keep the jobs' order: timed jobs alone, then the
/// others two at a time.
///
/// @param jobs      the timed ones first
/// @param finished  sections of an earlier study: those in which nothing failed are taken over
/// @throw what `observer.save` throws
void run_jobs(Study& study, const std::vector<StudyJob>& jobs, std::vector<StudySection> finished,
              const lab::Clock& clock, StudyObserver& observer);

}  // namespace tactile_net::study
