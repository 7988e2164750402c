/// @file
/// How often which duration occurred: 16 buckets per power of two, so that a quantile is exact to
/// 1/16; all memory is there from the start.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

class Histogram {
 public:
  void add(std::uint64_t nanoseconds) noexcept {
    ++counts_[bucket(nanoseconds)];
    ++total_;
    worst_ = std::max(worst_, nanoseconds);
  }

  /// Smallest bucket's upper end that at least `share` of the durations do not exceed [ns].
  [[nodiscard]] std::uint64_t quantile(double share) const noexcept {
    double below = 0.0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      below += static_cast<double>(counts_[i]);
      if (below >= share * static_cast<double>(total_)) return std::min(upper_end(i), worst_);
    }
    return worst_;
  }
  [[nodiscard]] std::uint64_t worst() const noexcept { return worst_; }

 private:
  // The four bits below the leading one, and how far they were shifted.
  static std::size_t bucket(std::uint64_t value) noexcept {
    const int shift = std::max(static_cast<int>(std::bit_width(value)) - 5, 0);
    return static_cast<std::size_t>(shift) * 16 + static_cast<std::size_t>(value >> shift);
  }
  static std::uint64_t upper_end(std::size_t bucket) noexcept {
    const std::size_t shift = bucket < 32 ? 0 : bucket / 16 - 1;
    const std::uint64_t leading = bucket - shift * 16;
    return (leading << shift) + ((std::uint64_t{1} << shift) - 1);
  }

  std::array<std::uint64_t, 1024> counts_{};
  std::uint64_t total_ = 0;
  std::uint64_t worst_ = 0;
};
