/// @file
/// Times measured with care: pinned to one core, warmed up, medians with their quartiles.
#pragma once

#include <sched.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace tactile_net::lab {

/// Keeps this thread on the core it runs on, until the end of the block. Children inherit it.
class Pinned {
 public:
  Pinned() {
    if (::sched_getaffinity(0, sizeof before_, &before_) != 0) return;
    const int core = ::sched_getcpu();
    if (core < 0) return;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<unsigned>(core), &one);
    pinned_ = ::sched_setaffinity(0, sizeof one, &one) == 0;
  }
  ~Pinned() {
    if (pinned_) ::sched_setaffinity(0, sizeof before_, &before_);
  }
  Pinned(const Pinned&) = delete;
  Pinned& operator=(const Pinned&) = delete;

 private:
  cpu_set_t before_{};
  bool pinned_ = false;
};

struct Seconds {
  double median = 0.0;
  double low = 0.0;   ///< first quartile
  double high = 0.0;  ///< third quartile
};

/// Of one call of `work`, which must be repeatable: batches long enough for the clock, as many as
/// fit into `budget` seconds, at least 5 and at most 101, after a first one that does not count.
[[nodiscard]] Seconds time_of(const auto& work, double budget = 0.03) {
  using Clock = std::chrono::steady_clock;
  const auto batch = [&](std::size_t repetitions) {
    const auto start = Clock::now();
    for (std::size_t i = 0; i < repetitions; ++i) work();
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  std::size_t repetitions = 1;
  double once = batch(1);
  while (once < 20e-6 && repetitions < (std::size_t{1} << 24)) {
    repetitions *= 2;
    once = batch(repetitions);
  }
  const auto fits = static_cast<std::size_t>(budget / once);
  std::vector<double> times;
  for (std::size_t i = 0; i < std::clamp<std::size_t>(fits, 5, 101); ++i)
    times.push_back(batch(repetitions) / static_cast<double>(repetitions));
  std::sort(times.begin(), times.end());
  const std::size_t n = times.size();
  return {times[n / 2], times[n / 4], times[3 * n / 4]};
}

}  // namespace tactile_net::lab
