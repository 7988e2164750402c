#include "tactile_net/lab/stopwatch.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

namespace tactile_net::lab {

double monotonic_time() noexcept {
  using Steady = std::chrono::steady_clock;
  static const Steady::time_point start = Steady::now();  // near: a double keeps every nanosecond
  return std::chrono::duration<double>(Steady::now() - start).count();
}

Pinned::Pinned() {
  if (::sched_getaffinity(0, sizeof before_, &before_) != 0) return;
  const int core = ::sched_getcpu();
  if (core < 0) return;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<unsigned>(core), &one);
  pinned_ = ::sched_setaffinity(0, sizeof one, &one) == 0;
}

Pinned::~Pinned() {
  if (pinned_) ::sched_setaffinity(0, sizeof before_, &before_);
}

Seconds time_of_batches(const std::function<void(std::size_t)>& batch, double budget,
                        const Clock& clock) {
  const auto seconds_of = [&](std::size_t repetitions) {
    const double start = clock();
    batch(repetitions);
    return clock() - start;
  };
  std::size_t repetitions = 1;
  double once = seconds_of(1);
  while (once < 20e-6 && repetitions < (std::size_t{1} << 24)) {
    repetitions *= 2;
    once = seconds_of(repetitions);
  }
  const auto fits = static_cast<std::size_t>(std::clamp(budget / once, 5.0, 101.0));
  std::vector<double> times;
  for (std::size_t i = 0; i < fits; ++i)
    times.push_back(seconds_of(repetitions) / static_cast<double>(repetitions));
  std::sort(times.begin(), times.end());
  const std::size_t n = times.size();
  return {times[n / 2], times[n / 4], times[3 * n / 4]};
}

}  // namespace tactile_net::lab
