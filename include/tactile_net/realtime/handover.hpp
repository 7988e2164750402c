/// @file
/// Gives a new object to the control loop, made elsewhere, and takes the old one back.
#pragma once

#include <atomic>
#include <memory>

namespace tactile_net {

/// One maker, one loop. `exchange` is one atomic operation: the loop never waits, never frees. For
/// a new plan (dead taxels, another alpha), build a ContactEstimator off the loop and offer it.
///
///     Handover<ContactEstimator> handover;
///     // off the loop                                        // in the loop, before a frame
///     handover.offer(std::make_unique<ContactEstimator>(plan));   handover.exchange(estimator);
template <class T>
class Handover {
 public:
  Handover() = default;
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;
  ~Handover() {
    delete offered_.load(std::memory_order_acquire);
    delete returned_.load(std::memory_order_acquire);
  }

  /// Call off the loop: offers an object, in place of one that was not taken, and destroys what the
  /// loop gave back. May free memory.
  void offer(std::unique_ptr<T> next) {
    collect();
    delete offered_.exchange(next.release(), std::memory_order_acq_rel);
  }

  /// Call off the loop: destroys what the loop gave back. May free memory.
  void collect() { delete returned_.exchange(nullptr, std::memory_order_acq_rel); }

  /// Call in the loop: takes what was offered as `current`, and is true if there was anything.
  /// False also while the maker has not yet collected the last object that the loop gave back.
  bool exchange(std::unique_ptr<T>& current) noexcept {
    if (offered_.load(std::memory_order_relaxed) == nullptr ||
        returned_.load(std::memory_order_relaxed) != nullptr)
      return false;
    T* next = offered_.exchange(nullptr, std::memory_order_acq_rel);
    if (next == nullptr) return false;  // replaced at this very moment
    returned_.store(current.release(), std::memory_order_release);
    current.reset(next);  // current is empty: frees nothing
    return true;
  }

 private:
  std::atomic<T*> offered_{nullptr};
  std::atomic<T*> returned_{nullptr};
};

}  // namespace tactile_net
