/// @file
/// Threads that end before their owner does. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace tactile_net {

/// Joined however their owner ends: std::jthread, which libc++ has from version 20 on.
class Threads {
 public:
  Threads() = default;
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
  ~Threads() {
    for (std::thread& thread : threads_) thread.join();
  }
  /// @throw std::system_error  the system has no more
  void start(const auto& work) { threads_.emplace_back(work); }

 private:
  std::vector<std::thread> threads_;
};

/// As many as run at the same time here, at least 1.
[[nodiscard]] inline std::size_t processors() {
  return std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace tactile_net
