/// @file
/// Times measured with care: pinned to one core, warmed up, medians with their quartiles.
#pragma once

#include <sched.h>

#include <cstddef>
#include <functional>

namespace tactile_net::lab {

/// Seconds since some moment, never less than before. Asked from several threads at once.
using Clock = std::function<double()>;

/// The machine's own.
[[nodiscard]] double monotonic_time() noexcept;

/// Keeps this thread on the core it runs on, until the end of the block. Children inherit it.
class Pinned {
 public:
  Pinned();
  ~Pinned();
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

/// Of one repetition of `batch`, which does its work as often as it is told. Batches are long
/// enough for the clock, as many as fit into `budget` seconds, at least 5 and at most 101, after a
/// first one that does not count.
[[nodiscard]] Seconds time_of_batches(const std::function<void(std::size_t repetitions)>& batch,
                                      double budget, const Clock& clock);

/// Of one call of `work`, which must be repeatable.
[[nodiscard]] Seconds time_of(const auto& work, double budget = 0.03,
                              const Clock& clock = monotonic_time) {
  return time_of_batches(
      [&](std::size_t repetitions) {
        for (std::size_t i = 0; i < repetitions; ++i) work();
      },
      budget, clock);
}

}  // namespace tactile_net::lab
