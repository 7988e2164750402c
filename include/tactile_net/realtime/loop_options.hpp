/// @file
/// What a control loop asks of an estimator besides its frames. Part of tactile_net::rt.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactile_net {

/// Off by default: what `update` does without them is the least.
struct LoopOptions {
  /// Numbers below 2.2e-308 are taken as 0 while `update` and `update_batch` run: some processors
  /// take a hundred times as long for them. The processor's switches (FTZ and DAZ of x86, FZ of
  /// aarch64) are put back as they were; other processors' are left alone.
  bool flush_denormals = false;
  /// A refused frame gets the last good answer, with the refused frames since as its `age`, in
  /// place of an estimate that is left untouched. The status says that it was refused, as ever.
  bool hold = false;
};

/// Frames since the estimator was made, a copy too, or `reset_counters` was called.
struct FrameCounters {
  std::uint64_t frames = 0;      ///< all that came
  std::uint64_t wrong_size = 0;  ///< of them refused, by status
  std::uint64_t not_finite = 0;
  std::uint64_t too_large = 0;

  [[nodiscard]] std::uint64_t refused() const noexcept {
    return wrong_size + not_finite + too_large;
  }
  bool operator==(const FrameCounters&) const = default;
};

/// What `ContactEstimator::prepare` has achieved.
struct Preparation {
  std::size_t bytes = 0;  ///< of the estimator's memory, the matrices that copies share included
  bool locked = false;    ///< all of it: the system will not take it away
};

}  // namespace tactile_net
