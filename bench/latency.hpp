/// @file
/// Times of calls shorter than a microsecond: in turn and amortised, or one by one as a
/// distribution.
#pragma once

#include <sched.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>
#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace bench {

/// The time stamp counter, which ticks at one rate whatever the core's clock does and reads in tens
/// of cycles; elsewhere std::chrono::steady_clock.
class Ticks {
 public:
#if defined(__x86_64__)
  /// Neither what comes before nor what comes after moves across.
  [[nodiscard]] static std::uint64_t now() noexcept {
    _mm_lfence();
    const std::uint64_t ticks = __rdtsc();
    _mm_lfence();
    return ticks;
  }
#else
  [[nodiscard]] static std::uint64_t now() noexcept {
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
  }
#endif

  Ticks() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const std::uint64_t first = now();
    while (Clock::now() - start < std::chrono::milliseconds(50)) {
    }
    const std::uint64_t last = now();
    seconds_ = std::chrono::duration<double>(Clock::now() - start).count() /
               static_cast<double>(last - first);
    std::array<std::uint64_t, 1001> empty{};
    for (std::uint64_t& one : empty) {
      one = now();
      one = now() - one;
    }
    std::nth_element(empty.begin(), empty.begin() + 500, empty.end());
    overhead_ = empty[500];
  }

  /// What two readings of the clock with nothing between them are apart.
  [[nodiscard]] double overhead() const noexcept {
    return seconds_ * static_cast<double>(overhead_);
  }
  /// Of what lies between two readings of the clock, their own time taken off.
  [[nodiscard]] double seconds(std::uint64_t ticks) const noexcept {
    return seconds_ * static_cast<double>(ticks > overhead_ ? ticks - overhead_ : 0);
  }

 private:
  double seconds_ = 0.0;
  std::uint64_t overhead_ = 0;
};

/// Keeps this thread on one core: the last one, which starts the fewest interrupts and daemons.
inline bool pin_to_one_core() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return false;
  std::size_t last = 0;
  for (std::size_t i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &allowed)) last = i;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(last, &one);
  return sched_setaffinity(0, sizeof one, &one) == 0;
}

/// While it lives, this thread runs before all others where the machine allows that: what other
/// programs do is not what is measured.
class FirstInLine {
 public:
  FirstInLine() {
    sched_param parameters{};
    parameters.sched_priority = 80;
    granted_ = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
  }
  ~FirstInLine() {
    const sched_param parameters{};
    if (granted_) (void)sched_setscheduler(0, SCHED_OTHER, &parameters);
  }
  FirstInLine(const FirstInLine&) = delete;
  FirstInLine& operator=(const FirstInLine&) = delete;
  [[nodiscard]] bool granted() const noexcept { return granted_; }

 private:
  bool granted_ = false;
};

/// Keeps the core busy in its registers alone.
inline void spin(std::size_t rounds) noexcept {
  for (std::size_t i = 0; i < rounds; ++i) asm volatile("" : "+r"(i));
}

/// Quantile of times, 0 to 1.
inline double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

using Call = std::function<void()>;

/// Rounds of several calls, in turn; seconds[call][round].
struct InTurn {
  std::vector<std::vector<double>> seconds;

  [[nodiscard]] double median(std::size_t call) const { return quantile(seconds[call], 0.5); }
  /// Median of the rounds' ratios: what slows a whole round down cancels.
  [[nodiscard]] double ratio(std::size_t call, std::size_t rival) const {
    std::vector<double> ratios(seconds[call].size());
    std::transform(seconds[call].begin(), seconds[call].end(), seconds[rival].begin(),
                   ratios.begin(), std::divides<>());
    return quantile(ratios, 0.5);
  }
};

/// Seconds a call, hot: in every round each call is repeated for about `batch` seconds, so that
/// reading the clock is amortised, after a few repetitions that are not timed. One is not enough
/// where an outer cache takes in what an inner one drops: the second finds it there.
inline InTurn in_turn(const std::vector<Call>& calls, std::size_t rounds, double batch = 1e-4) {
  using Clock = std::chrono::steady_clock;
  const auto timed = [](const Call& call, std::size_t repeats) {
    const Clock::time_point start = Clock::now();
    for (std::size_t i = 0; i < repeats; ++i) call();
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  std::vector<std::size_t> repeats;
  for (const Call& call : calls) {
    std::size_t count = 1;
    while (timed(call, count) < batch) count *= 2;
    repeats.push_back(count);
  }
  InTurn result{std::vector<std::vector<double>>(calls.size())};
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < calls.size(); ++i) {
      (void)timed(calls[i], 2 + repeats[i] / 3);
      result.seconds[i].push_back(timed(calls[i], repeats[i]) / static_cast<double>(repeats[i]));
    }
  return result;
}

struct Distribution {
  double p50 = 0.0, p99 = 0.0, p999 = 0.0, worst = 0.0;  // [s]
};

/// Each call timed by itself; `before` is not timed.
template <class Before, class Timed>
Distribution distribution(const Ticks& ticks, std::size_t calls, Before before, Timed call) {
  std::vector<double> seconds(calls);
  for (std::size_t i = 0; i < calls / 10; ++i) {  // to warm up
    before();
    call();
  }
  for (double& one : seconds) {
    before();
    const std::uint64_t start = Ticks::now();
    call();
    one = ticks.seconds(Ticks::now() - start);
  }
  return {quantile(seconds, 0.5), quantile(seconds, 0.99), quantile(seconds, 0.999),
          quantile(seconds, 1.0)};
}

}  // namespace bench
