#include "tactile_net/sweep/sweep.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "numeric/threads.hpp"
#include "sweep/worker.hpp"
#include "tactile_net/frames/folder_lock.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/sweep/journal.hpp"

namespace tactile_net::sweep {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error))
    throw frames::CannotCreate(folder.string() +
                               ": error: cannot be created as a folder: " + error.message());
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw frames::CannotCreate(folder.string() +
                               ": error: cannot be written to: " + std::strerror(errno));
}

[[noreturn]] void fail_to_write(const fs::path& journal, int error) {
  throw std::runtime_error(journal.string() + " could not be written: " + std::strerror(error) +
                           "; what is done is kept: run the same sweep again to go on");
}

/// Hands points to workers until all are done.
class Supervisor {
 public:
  Supervisor(const Study& study, fs::path place, const Options& options, Observer& observer,
             const Rows& rows)
      : study_(study), place_(std::move(place)), options_(options), observer_(observer) {
    for (std::size_t i = 0; i < study.points(); ++i) {
      if (!options.shard.has(i)) continue;
      ++progress_.points;
      if (rows.has(i))
        ++progress_.done;
      else
        pending_.push_back(i);
    }
    progress_.earlier = progress_.done;
    start_ = options_.clock();
  }

  Progress run() {
    const std::size_t jobs = options_.jobs == 0 ? processors() : options_.jobs;
    workers_.resize(std::min(jobs, pending_.size()));
    // A chunk is small beside a worker's share, so that all end at about the same time.
    chunk_ = workers_.empty() ? 1
                              : std::clamp<std::size_t>(pending_.size() / workers_.size() / 8, 1,
                                                        Worker::most_points_at_once);
    while (!progress_.complete() && !observer_.stop()) {
      for (std::size_t i = 0; i < workers_.size(); ++i) employ(i);
      wait();
      tell(false);
    }
    tell(true);
    return progress_;
  }

 private:
  [[nodiscard]] fs::path journal(std::size_t worker) const {
    return place_ / ("worker-" + std::to_string(worker + 1) + ".journal");
  }

  /// Gives an idle worker points, if there are any; starts it where it is not there.
  void employ(std::size_t i) {
    if (workers_[i] && !workers_[i]->idle()) return;
    std::deque<std::size_t> points;
    if (!alone_.empty()) {
      points.push_back(alone_.front());
      alone_.pop_front();
    } else {
      const auto end =
          pending_.begin() + static_cast<std::ptrdiff_t>(std::min(chunk_, pending_.size()));
      points.assign(pending_.begin(), end);
      pending_.erase(pending_.begin(), end);
    }
    if (points.empty()) return;
    if (!workers_[i]) {
      drop_torn_line_of(i);
      workers_[i] = std::make_unique<Worker>(study_, journal(i), options_.simulator);
    }
    workers_[i]->give(std::move(points));
  }

  /// Of a worker that died while it wrote.
  void drop_torn_line_of(std::size_t i) const {
    std::error_code error;
    if (fs::exists(journal(i), error)) drop_torn_line(journal(i));
  }

  /// Until a worker has something to say, a fifth of a second at most.
  void wait() {
    std::vector<pollfd> polled;
    std::vector<std::size_t> whose;
    for (std::size_t i = 0; i < workers_.size(); ++i)
      if (workers_[i]) {
        polled.push_back({workers_[i]->socket(), POLLIN, 0});
        whose.push_back(i);
      }
    constexpr int heartbeat_ms = 200;
    if (::poll(polled.data(), polled.size(), heartbeat_ms) < 0 && errno != EINTR)
      fail_with_errno("poll");
    for (std::size_t k = 0; k < polled.size(); ++k)
      if (polled[k].revents != 0) hear(whose[k]);
  }

  void hear(std::size_t i) {
    Worker& worker = *workers_[i];
    while (const auto report = worker.report()) {
      if (report->error != 0) fail_to_write(journal(i), report->error);
      ++progress_.done;
    }
    if (worker.dead()) bury(i);
  }

  /// The point a dead worker was at is done again alone, and so is what else it was given.
  void bury(std::size_t i) {
    const std::deque<std::size_t> left = workers_[i]->points();
    workers_[i].reset();
    ++progress_.deaths;
    if (left.empty()) return;
    alone_.insert(alone_.end(), left.begin() + 1, left.end());
    if (++deaths_[left.front()] < most_deaths)
      alone_.push_back(left.front());
    else
      give_up(left.front());
  }

  void give_up(std::size_t index) {
    const fs::path journal = place_ / "driver.journal";
    const Descriptor file(open_journal(journal, study_));
    const int error =
        file.open()
            ? append(file.get(), death_line(failed_row(study_.point(index),
                                                       "its worker died, " +
                                                           std::to_string(most_deaths) + " times"),
                                            study_.keep()))
            : errno;
    if (error != 0) fail_to_write(journal, error);
    ++progress_.done;
  }

  void tell(bool at_once) {
    const double now = options_.clock();
    if (!at_once && now - told_ < 0.2) return;
    told_ = now;
    const auto own = static_cast<double>(progress_.done - progress_.earlier);
    if (own > 0.0)
      progress_.seconds_left =
          (now - start_) / own * static_cast<double>(progress_.points - progress_.done);
    observer_.progress(progress_);
  }

  const Study& study_;
  fs::path place_;
  const Options& options_;
  Observer& observer_;
  Progress progress_;
  std::deque<std::size_t> pending_;
  std::deque<std::size_t> alone_;  // to be done one at a time
  std::map<std::size_t, std::size_t> deaths_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::size_t chunk_ = 1;
  double start_ = 0.0;
  double told_ = 0.0;
};

}  // namespace

Shard shard_in(std::string_view text) {
  const std::size_t slash = text.find('/');
  const auto number = whole_number(text.substr(0, slash));
  const auto count = slash == text.npos ? std::nullopt : whole_number(text.substr(slash + 1));
  if (!number || !count)
    throw std::invalid_argument("'" + std::string(text) +
                                "' is not a shard: the third of eight is 3/8");
  const Shard shard{.number = *number, .count = *count};
  if (shard.number < 1 || shard.number > shard.count)
    throw std::invalid_argument("'" + std::string(text) + "': shards are counted from 1 to " +
                                std::to_string(shard.count));
  return shard;
}

Progress sweep(const Study& study, const fs::path& folder, const Options& options,
               Observer& observer) {
  (void)lab::make_simulator(options.simulator);  // checks its options
  make_folder(folder);
  const fs::path place = folder / ("shard-" + std::to_string(options.shard.number) + "-of-" +
                                   std::to_string(options.shard.count));
  const frames::FolderLock lock(place);
  make_folder(place);
  for (const fs::path& journal : journals_in(place)) drop_torn_line(journal);
  Rows rows(head_of(study));
  for (const fs::path& journal : journals_in(folder)) rows.add(journal);
  return Supervisor(study, place, options, observer, rows).run();
}

}  // namespace tactile_net::sweep
