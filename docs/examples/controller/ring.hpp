/// @file
/// A queue of slots between two threads, one that fills and one that empties: wait-free on both
/// sides, in order, without a copy or an allocation after construction.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

template <class T>
class Ring {
 public:
  /// @param empty  copied into every slot, with all the memory that a slot will ever need
  Ring(std::size_t slots, const T& empty) : slots_(slots + 1, empty) {}

  /// The filling thread: a slot to write to, then `filled()`; null if all are full.
  [[nodiscard]] T* to_fill() noexcept {
    const std::size_t at = last_.load(std::memory_order_relaxed);
    return after(at) == first_.load(std::memory_order_acquire) ? nullptr : &slots_[at];
  }
  void filled() noexcept {
    last_.store(after(last_.load(std::memory_order_relaxed)), std::memory_order_release);
  }
  /// Nothing more will come.
  void close() noexcept { closed_.store(true, std::memory_order_release); }

  /// The emptying thread: the oldest full slot, then `emptied()`; null if there is none.
  [[nodiscard]] T* to_empty() noexcept {
    const std::size_t at = first_.load(std::memory_order_relaxed);
    return at == last_.load(std::memory_order_acquire) ? nullptr : &slots_[at];
  }
  void emptied() noexcept {
    first_.store(after(first_.load(std::memory_order_relaxed)), std::memory_order_release);
  }
  /// Nothing is left, and nothing more will come.
  [[nodiscard]] bool finished() noexcept {
    return closed_.load(std::memory_order_acquire) && to_empty() == nullptr;
  }

 private:
  [[nodiscard]] std::size_t after(std::size_t at) const noexcept {
    return at + 1 == slots_.size() ? 0 : at + 1;
  }

  std::vector<T> slots_;
  // A cache line each: a thread's own index does not travel because the other one wrote to its.
  alignas(64) std::atomic<std::size_t> first_{0};
  alignas(64) std::atomic<std::size_t> last_{0};
  alignas(64) std::atomic<bool> closed_{false};
};
