#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "realtime/estimator_state.hpp"

#if __has_include(<sys/mman.h>) && __has_include(<unistd.h>)
#include <sys/mman.h>
#include <unistd.h>
#define TACTILE_NET_LOCKS_MEMORY
#endif

namespace tactile_net {
namespace {

/// Locks memory, piece after piece, as far as the system allows.
class MemoryLock {
 public:
  void add(const void* data, std::size_t size) noexcept {
    if (size == 0) return;
    bytes_ += size;
    locked_ = is_locked(data, size) && locked_;
  }
  template <class T>
  void operator()(const Aligned<T>& array) noexcept {
    add(array.data(), array.bytes());
  }
  template <class T>
  void operator()(const std::vector<T>& array) noexcept {
    add(array.data(), array.capacity() * sizeof(T));
  }
  /// Its numbers are those of frames; whether a reading is judged is asked when a taxel dies.
  void operator()(const std::vector<bool>&) noexcept {}

  [[nodiscard]] Preparation result() const noexcept { return {bytes_, locked_ && bytes_ > 0}; }

 private:
  /// Whole pages. They stay locked when the estimator is gone: others of their bytes may be another
  /// one's, and the system does not count how often a page was locked.
  static bool is_locked([[maybe_unused]] const void* data,
                        [[maybe_unused]] std::size_t size) noexcept {
#if defined(TACTILE_NET_LOCKS_MEMORY)
    const long page = ::sysconf(_SC_PAGESIZE);
    if (page <= 0) return false;
    const auto before = reinterpret_cast<std::uintptr_t>(data) % static_cast<std::uintptr_t>(page);
    return ::mlock(static_cast<const std::byte*>(data) - before, size + before) == 0;
#else
    return false;
#endif
  }

  std::size_t bytes_ = 0;
  bool locked_ = true;
};

template <class T>
void add_product(const ReadyProduct<T>& product, MemoryLock& lock) noexcept {
  for (const Panels<T>& panels : product.factors) lock(panels.values);
  lock(product.factors);
  lock(product.classes);
  for (const auto* folding : {&product.fold_x, &product.fold_y})
    if (*folding) (*folding)->for_each_array(lock);
}

}  // namespace

void ContactEstimator::add_memory(auto& lock) const noexcept {
  const Ready& ready = *ready_;
  lock.add(&ready, sizeof ready);
  if (ready.ranges) {
    lock(ready.ranges->lowest);
    lock(ready.ranges->highest);
  }
  lock(ready.taxels);
  lock(ready.weights);
  lock(ready.leverages);
  lock(ready.border);
  lock(ready.channel_ends);
  lock(ready.window_variances);
  lock(ready.judged);
  lock(ready.fill);
  if (ready.cells) {
    lock(ready.cells->deviations);
    lock(ready.cells->window_deviations);
  }
  if (ready.product64) add_product(*ready.product64, lock);
  if (ready.product32) add_product(*ready.product32, lock);
  if (ready.prediction) add_product(*ready.prediction, lock);
  if (ready.line_cells) {
    lock(ready.line_cells->deviations);
    lock(ready.line_cells->window_deviations);
  }
  if (ready.cone) add_product(ready.cone->product, lock);

  const Scratch& scratch = *scratch_;
  lock.add(&scratch, sizeof scratch);
  for (const Aligned<double>* const array :
       {&scratch.baseline, &scratch.zero, &scratch.x, &scratch.predicted, &scratch.spread,
        &scratch.weights, &scratch.squared_weights, &scratch.remaining, &scratch.shares,
        &scratch.product64, &scratch.fill, &scratch.dead_rows, &scratch.cholesky, &scratch.filled,
        &scratch.marks.sums, &scratch.marks.along, &scratch.loop.converted,
        &scratch.loop.held_tractions})
    lock(*array);
  lock(scratch.product32);
  lock(scratch.labels);
  scratch.follower.for_each_array(lock);
  if (scratch.cone) scratch.cone->for_each_array(lock);
  lock(scratch.marks.marks);
  lock(scratch.marks.queue);
  lock(scratch.marks.patches);
  lock(scratch.constants);
  lock(scratch.unread);
  lock(scratch.dead);
  if (scratch.block == nullptr) return;
  lock.add(scratch.block.get(), sizeof *scratch.block);
  lock(scratch.block->x);
  lock(scratch.block->explained);
  scratch.block->product64.for_each_array(lock);
  scratch.block->product32.for_each_array(lock);
  scratch.block->prediction.for_each_array(lock);
}

/// Calls `update` as a loop does: with zeros, and with constants both ways, one of which presses,
/// larger and larger ones until what presses is beyond noise.
void ContactEstimator::run_frames() noexcept {
  LoopState& loop = scratch_->loop;
  const FrameCounters counted = loop.counters;
  const std::span<double> frame(loop.converted.data(), readings());
  ContactEstimate estimate{.tractions = {loop.held_tractions.data(), tractions()}};
  std::fill(frame.begin(), frame.end(), 0.0);
  bool go_on = update(frame, estimate) == FrameStatus::ok;
  for (double size = 1.0; go_on && size < 0x1p200; size *= 0x1p10)
    for (const double value : {size, -size}) {
      if (!go_on) break;
      for (std::size_t i = 0; i < frame.size(); ++i) frame[i] = scratch_->baseline[i] + value;
      go_on = update(frame, estimate) == FrameStatus::ok && !estimate.contact;
    }
  loop.counters = counted;
  loop.has_held = false;
}

Preparation ContactEstimator::prepare() noexcept {
  MemoryLock lock;
  add_memory(lock);
  run_frames();
  return lock.result();
}

}  // namespace tactile_net
