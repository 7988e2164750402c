/// @file
/// The largest number of each frame, by which frames are seen that were divided by it. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::lab {

/// Takes a recording frame by frame, in memory that does not grow with it.
class PeakTrack {
 public:
  explicit PeakTrack(const SignalLayout& layout) {
    for (const Channel& channel : layout.channels)
      ranges_.push_back({.first = channel.first, .end = channel.first + channel.count});
    if (layout.channels.size() > 1) ranges_.push_back({.first = 0, .end = layout.readings.size()});
  }

  /// @param numbers  the frame as the file has it; NaN: missing
  /// @param living   per reading: the others are not looked at
  void add(std::span<const double> numbers, const std::vector<bool>& living) {
    for (Range& range : ranges_)
      for (Peaks* peaks : {&range.by_number, &range.by_size}) {
        double largest = -std::numeric_limits<double>::infinity();
        std::size_t holder = 0;
        std::size_t holders = 0;
        for (std::size_t i = range.first; i < range.end; ++i) {
          if (!living[i] || std::isnan(numbers[i])) continue;
          if (numbers[i] != 0.0) range.least = std::min(range.least, std::abs(numbers[i]));
          const double number = peaks == &range.by_size ? std::abs(numbers[i]) : numbers[i];
          if (number > largest) {
            largest = number;
            holder = i;
            holders = 0;
          }
          if (number == largest) ++holders;
        }
        // A frame of zeros was divided by nothing.
        if (holders > 0 && largest != 0.0) peaks->add(largest, holder, holders);
      }
  }

  struct Same {
    double number = 0.0;     ///< as the file has it
    std::size_t frames = 0;  ///< whose largest it is
  };
  /// The number that is the largest of every frame of a channel, or of all, one taxel's and in turn
  /// of many: at the end of a range several taxels are at once, and always the same ones.
  [[nodiscard]] std::optional<Same> same() const {
    for (const Range& range : ranges_)
      for (const Peaks* peaks : {&range.by_number, &range.by_size})
        if (peaks->is_one_number() && std::abs(peaks->number) >= least_steps * range.least)
          return Same{peaks->number, peaks->equal};
    return std::nullopt;
  }

 private:
  static constexpr std::size_t least_frames = 10;
  static constexpr std::size_t least_taxels = 4;
  static constexpr double least_steps = 10.0;  // a coarse converter's noise is of one step

  struct Peaks {
    void add(double largest, std::size_t of, std::size_t how_many) {
      ++frames;
      if (equal > 0 && std::abs(largest - number) <= 1e-9 * std::abs(number)) {
        if (of != last) ++turns;
      } else if (equal == 0 || largest > number) {
        number = largest;
        equal = holders = turns = 0;
        taxels.clear();
      } else {
        return;
      }
      ++equal;
      holders += how_many;
      last = of;
      taxels.insert(of);
    }

    [[nodiscard]] bool is_one_number() const {
      return frames >= least_frames && 20 * equal >= 19 * frames && 10 * holders <= 11 * equal &&
             10 * turns >= equal && taxels.size() >= least_taxels;
    }

    std::size_t frames = 0;
    double number = 0.0;      // the largest of all frames
    std::size_t equal = 0;    // frames whose largest it is
    std::size_t holders = 0;  // readings that hold it, in all of them
    std::size_t turns = 0;    // how often another reading is the first of them than before
    std::size_t last = 0;
    std::set<std::size_t> taxels{};  // those first ones
  };

  /// Readings of a channel, or of all.
  struct Range {
    std::size_t first = 0;
    std::size_t end = 0;
    Peaks by_number{};
    Peaks by_size{};
    double least = std::numeric_limits<double>::infinity();  // size but zero
  };

  std::vector<Range> ranges_{};
};

}  // namespace tactile_net::lab
