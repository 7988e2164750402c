#include "tactile_net/sweep/sweep.hpp"

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "lab/in_order.hpp"
#include "numeric/threads.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/sweep/rows_file.hpp"

namespace tactile_net::sweep {
namespace {

/// Simulators, one for each thread that works at the same time.
class Simulators {
 public:
  explicit Simulators(const lab::SimulatorChoice& choice) : choice_(choice) {
    give(lab::make_simulator(choice));  // checks its options
  }
  std::unique_ptr<Simulator> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return lab::make_simulator(choice_);
    auto simulator = std::move(free_.back());
    free_.pop_back();
    return simulator;
  }
  void give(std::unique_ptr<Simulator> simulator) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(simulator));
  }

 private:
  const lab::SimulatorChoice& choice_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Simulator>> free_;
};

/// Ends points that are under way.
class Stopper final : public lab::Observer {
 public:
  [[nodiscard]] bool stop() const override { return stopped_; }
  void end() { stopped_ = true; }

 private:
  std::atomic<bool> stopped_ = false;
};

struct Job {
  std::size_t index = 0;
  std::string lines{};
};

}  // namespace

Progress sweep(const Study& study, const std::filesystem::path& file, const Options& options,
               Observer& observer) {
  const std::size_t end = options.points.end_in(study.points());
  if (options.points.first >= end)
    throw InputError(
        {{.file = study.file(),
          .message = "has " + std::to_string(study.points()) + " points, and none from " +
                     std::to_string(options.points.first) + " on",
          .hint = "points are counted from 0"}});
  Simulators simulators(options.simulator);
  RowsFile rows(study, file);
  Progress progress{.points = end - options.points.first};
  for (std::size_t i = options.points.first; i < end; ++i)
    if (rows.rows().has(i)) ++progress.earlier;
  progress.done = progress.earlier;

  const double start = options.clock();
  double told = start;
  const auto tell = [&](double now) {
    told = now;
    const auto own = static_cast<double>(progress.done - progress.earlier);
    if (own > 0.0)
      progress.seconds_left =
          (now - start) / own * static_cast<double>(progress.points - progress.done);
    observer.progress(progress);
  };
  Stopper stopper;
  const auto look_up = [&] {
    if (const double now = options.clock(); now - told >= 0.2) tell(now);
    try {
      if (observer.stop()) stopper.end();
    } catch (...) {
      stopper.end();  // no thread is waited for longer than it takes to its next step
      throw;
    }
  };

  std::size_t next_point = options.points.first;
  lab::in_order<Job>(
      options.jobs == 0 ? processors() : options.jobs,
      [&](Job& job) {
        while (next_point < end && rows.rows().has(next_point)) ++next_point;
        if (next_point == end || stopper.stop()) return false;
        job.index = next_point++;
        return true;
      },
      [&](Job& job) {
        if (stopper.stop()) return;
        auto simulator = simulators.take();
        job.lines = lines(solve(study, job.index, *simulator, stopper), study.keep());
        simulators.give(std::move(simulator));
      },
      [&](Job& job) {
        look_up();
        if (stopper.stop()) return;  // the point may have been ended half way
        rows.append(job.lines);
        ++progress.done;
      },
      look_up);
  tell(options.clock());
  return progress;
}

}  // namespace tactile_net::sweep
