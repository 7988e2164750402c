#include "tactile_net/study/runner.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "numeric/threads.hpp"

namespace tactile_net::study {
namespace {

/// What is done, and how long the rest takes at that pace.
class Pace {
 public:
  Pace(const std::vector<StudyJob>& jobs, const lab::Clock& clock)
      : clock_(clock), start_(clock()) {
    for (const StudyJob& job : jobs) total_ += job.weight;
  }
  void done(const StudyJob& job) { done_ += job.weight; }
  /// Done by an earlier study: it says nothing of this one's pace.
  void taken_over(const StudyJob& job) {
    earlier_ += job.weight;
    done(job);
  }
  [[nodiscard]] StudyProgress progress(const Job& job) const {
    StudyProgress progress{.job = job, .share = done_ / total_};
    if (done_ > earlier_)
      progress.seconds_left = (clock_() - start_) / (done_ - earlier_) * (total_ - done_);
    return progress;
  }

 private:
  const lab::Clock& clock_;
  double start_;
  double total_ = 0.0;
  double done_ = 0.0;
  double earlier_ = 0.0;
};

class Runner {
 public:
  Runner(Study& study, const std::vector<StudyJob>& jobs, const lab::Clock& clock,
         StudyObserver& observer)
      : study_(study),
        jobs_(jobs),
        observer_(observer),
        sections_(jobs.size()),
        pace_(jobs, clock) {}

  void take_over(std::vector<StudySection> finished) {
    for (std::size_t i = 0; i < jobs_.size(); ++i)
      for (StudySection& section : finished)
        if (!sections_[i] && section.job == jobs_[i].job && section.whole()) {
          sections_[i] = std::move(section);
          pace_.taken_over(jobs_[i]);
        }
  }

  /// Jobs first ... last - 1, `workers` at a time.
  void run(std::size_t first, std::size_t last, std::size_t workers) {
    if (first == last) return;
    next_ = first;
    last_ = last;
    running_ = workers;
    Threads threads;
    for (std::size_t k = 0; k < workers; ++k) threads.start([this] { work(); });
    watch();
    if (failure_) std::rethrow_exception(failure_);
  }

  /// The study so far, saved.
  void publish() {
    study_.sections.clear();
    study_.complete = true;
    for (const auto& section : sections_)
      if (section)
        study_.sections.push_back(*section);
      else
        study_.complete = false;
    observer_.save(study_);
  }

 private:
  /// One job after the other, until none is left.
  void work() {
    std::unique_lock lock(mutex_);
    while (next_ < last_ && !observer_.stop()) {
      const std::size_t i = next_++;
      if (sections_[i]) continue;
      begun_ = i;
      lock.unlock();
      StudySection section = jobs_[i].run();
      lock.lock();
      // What a stop has cut off, its simulator killed, is no result.
      if (!observer_.stop()) sections_[i] = std::move(section);
      pace_.done(jobs_[i]);
      try {
        publish();
      } catch (...) {
        failure_ = std::current_exception();
        next_ = last_;  // the others finish what they have begun, no more
      }
    }
    --running_;
    changed_.notify_one();
  }

  /// Tells the observer how far the workers are until they have ended. A stop may come, and this
  /// thread may wake, before a worker has begun a job: then there is nothing to tell.
  void watch() {
    std::unique_lock lock(mutex_);
    while (running_ > 0) {
      changed_.wait_for(lock, std::chrono::milliseconds(200));
      if (!begun_) continue;
      StudyProgress progress = pace_.progress(jobs_[*begun_].job);
      progress.stopping = observer_.stop();
      observer_.progress(progress);
    }
  }

  Study& study_;
  const std::vector<StudyJob>& jobs_;
  StudyObserver& observer_;
  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::vector<std::optional<StudySection>> sections_;
  Pace pace_;
  std::size_t next_ = 0;
  std::size_t last_ = 0;
  std::size_t running_ = 0;
  std::optional<std::size_t> begun_;  // the job begun last
  std::exception_ptr failure_;        // of saving
};

}  // namespace

void run_jobs(Study& study, const std::vector<StudyJob>& jobs, std::vector<StudySection> finished,
              const lab::Clock& clock, StudyObserver& observer) {
  const auto timed =
      std::find_if(jobs.begin(), jobs.end(), [](const StudyJob& job) { return !job.timed; });
  const auto arithmetic = static_cast<std::size_t>(timed - jobs.begin());
  Runner runner(study, jobs, clock, observer);
  runner.take_over(std::move(finished));
  runner.run(0, arithmetic, 1);
  runner.run(arithmetic, jobs.size(), 2);
  runner.publish();
}

}  // namespace tactile_net::study
