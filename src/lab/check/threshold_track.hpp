/// @file
/// The least sizes among a channel's numbers, by which a threshold is seen that writes what lies
/// below it as 0. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "lab/check/code_track.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::lab {

/// Takes a recording frame by frame, in memory that does not grow with it.
class ThresholdTrack {
 public:
  explicit ThresholdTrack(const SignalLayout& layout)
      : channels_(layout.channels),
        sizes_(layout.channels.size(), ExtremeNumbers(-1.0)),
        readings_(layout.readings.size()) {}

  /// @param numbers  the frame as the file has it; NaN: missing
  /// @param living   per reading: the others are not looked at
  void add(std::span<const double> numbers, const std::vector<bool>& living) {
    for (std::size_t c = 0; c < channels_.size(); ++c)
      for (std::size_t i = channels_[c].first; i < channels_[c].first + channels_[c].count; ++i) {
        if (!living[i] || std::isnan(numbers[i])) continue;
        if (numbers[i] == 0.0) {
          ++readings_[i].zeros;
          continue;
        }
        const double size = std::abs(numbers[i]);
        readings_[i].least = std::min(readings_[i].least, size);
        sizes_[c].add(size, i);
      }
  }

  /// Of a channel: many numbers lie above the threshold, up to twice it, and none below, where a
  /// converter's steps would let some, but zeros of readings that are near it at other times.
  [[nodiscard]] std::optional<double> threshold(std::size_t channel) const {
    constexpr std::size_t least_above = 20;
    constexpr std::size_t least_zeros = 5;
    const std::vector<ExtremeNumber> sizes = sizes_[channel].all();
    if (sizes.size() < 3) return std::nullopt;
    const double least = sizes.front().number;
    std::size_t above = 0;
    double step = least;
    for (std::size_t k = 0; k < sizes.size() && sizes[k].number <= 2.0 * least; ++k) {
      above += sizes[k].count;
      // What rounding sets apart is the same number.
      if (k == 0) continue;
      if (const double gap = sizes[k].number - sizes[k - 1].number; gap > 1e-6 * least)
        step = std::min(step, gap);
    }
    std::size_t zeros = 0;
    for (std::size_t i = channels_[channel].first;
         i < channels_[channel].first + channels_[channel].count; ++i)
      if (readings_[i].least <= 2.0 * least) zeros += readings_[i].zeros;
    if (above < least_above || zeros < least_zeros || least < 1.5 * step) return std::nullopt;
    return least;
  }

 private:
  struct Small {
    std::size_t zeros = 0;
    double least = std::numeric_limits<double>::infinity();  // of the others
  };
  std::vector<Channel> channels_;
  std::vector<ExtremeNumbers> sizes_;  // of each, from the least upwards
  std::vector<Small> readings_;
};

}  // namespace tactile_net::lab
