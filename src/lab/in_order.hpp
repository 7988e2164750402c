/// @file
/// Jobs that do not depend on one another, worked on by several threads and handed back in the
/// order in which they came. Private.
///
///     in_order<Job>(processors(), next, work, use);
///     // as: while (next(job)) { work(job); use(job); }
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <system_error>
#include <type_traits>
#include <utility>

#include "numeric/threads.hpp"

namespace tactile_net::lab {

/// Does nothing while a job is waited for.
struct Idle {
  void operator()() const noexcept {}
};

/// What `next`, `work` and `use` throw is thrown here after all jobs before it have been used, as
/// in the loop above. A few jobs a thread are read ahead.
///
/// @param threads  at most so many work at a time; 1 without `waiting`: this one, one job after the
///                 other. Where the system gives none, this one too
/// @param next     bool(Job&): false where there is no more; called by this thread
/// @param work     void(Job&): by any
/// @param use      void(Job&): by this thread, in the order of `next`
/// @param waiting  void(): by this thread, five times a second while it waits for a job; may throw
template <typename Job, typename Waiting = Idle>
void in_order(std::size_t threads, const auto& next, const auto& work, const auto& use,
              const Waiting& waiting = {}) {
  const auto one_by_one = [&] {
    for (Job job; next(job); job = Job()) {
      work(job);
      use(job);
    }
  };
  constexpr bool is_told = !std::is_same_v<Waiting, Idle>;
  if (threads <= 1 && !is_told) return one_by_one();

  struct Slot {
    Job job{};
    bool taken = false;
    bool done = false;
    std::exception_ptr error{};
  };
  constexpr std::size_t jobs_of_one = 4;  // ahead, so that no thread waits for a long job's turn
  std::mutex mutex;
  std::condition_variable to_do;
  std::condition_variable done;
  std::deque<Slot> slots;  // the oldest first; addresses stay as they are
  bool over = false;
  const auto work_on = [&] {
    std::unique_lock lock(mutex);
    while (true) {
      const auto free = [&] {
        return std::find_if(slots.begin(), slots.end(), [](const Slot& one) { return !one.taken; });
      };
      to_do.wait(lock, [&] { return over || free() != slots.end(); });
      if (over) return;
      Slot& mine = *free();
      mine.taken = true;
      lock.unlock();
      try {
        work(mine.job);
      } catch (...) {
        mine.error = std::current_exception();
      }
      lock.lock();
      mine.done = true;
      done.notify_one();
    }
  };
  // Declared first: it is told that all is over before it joins.
  Threads running;
  struct Ending {
    std::mutex& mutex;
    std::condition_variable& to_do;
    bool& over;
    ~Ending() {
      const std::lock_guard lock(mutex);
      over = true;
      to_do.notify_all();
    }
  } const ending{mutex, to_do, over};
  std::size_t started = 0;
  try {
    for (; started < threads; ++started) running.start(work_on);
  } catch (const std::system_error&) {
    if (started == 0) return one_by_one();
  }

  std::exception_ptr unread;
  for (bool more = true; more || !slots.empty();) {
    while (more && slots.size() < jobs_of_one * started) {
      Slot slot;
      try {
        more = next(slot.job);
      } catch (...) {
        unread = std::current_exception();
        more = false;
      }
      if (!more) break;
      const std::lock_guard lock(mutex);
      slots.push_back(std::move(slot));
      to_do.notify_one();
    }
    if (slots.empty()) break;
    {
      std::unique_lock lock(mutex);
      const auto is_done = [&] { return slots.front().done; };
      if constexpr (is_told) {
        while (!done.wait_for(lock, std::chrono::milliseconds(200), is_done)) {
          lock.unlock();
          waiting();
          lock.lock();
        }
      } else {
        done.wait(lock, is_done);
      }
    }
    if (slots.front().error) std::rethrow_exception(slots.front().error);
    use(slots.front().job);
    const std::lock_guard lock(mutex);
    slots.pop_front();
  }
  if (unread) std::rethrow_exception(unread);
}

}  // namespace tactile_net::lab
