/// @file
/// Readings that jump for one frame and come back, one taxel alone. Private.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::lab {

/// Takes a recording frame by frame, in memory that does not grow with it.
class SpikeTrack {
 public:
  /// Of one reading: the lesser of its two jumps, to the value and back.
  struct Spikes {
    double largest = 0.0;                ///< [unit of the reading]
    std::size_t frame = 0;               ///< of the largest
    std::map<int, std::size_t> sizes{};  ///< how many there are of each power of two
  };

  /// @param weights  per reading: what makes channels comparable
  SpikeTrack(const SignalLayout& layout, std::vector<double> weights);

  /// O(readings). @param readings  NaN: missing
  void add(std::span<const double> readings);

  /// Per reading.
  [[nodiscard]] std::span<const Spikes> spikes() const noexcept { return spikes_; }

 private:
  std::vector<std::size_t> taxels_;  // per reading
  std::vector<double> weights_;
  std::vector<Spikes> spikes_;
  std::vector<double> before_{};  // two frames ago
  std::vector<double> last_{};
  std::size_t frames_ = 0;
};

}  // namespace tactile_net::lab
