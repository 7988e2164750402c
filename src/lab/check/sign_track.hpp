/// @file
/// Whole numbers that lost their sign: below zero they are there as 2^8 or 2^16 more. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::lab {

/// Takes a recording frame by frame, in memory that does not grow with it.
class SignTrack {
 public:
  explicit SignTrack(const SignalLayout& layout)
      : channels_(layout.channels),
        found_(2 * layout.channels.size()),
        crossings_(2 * layout.readings.size()) {}

  /// @param numbers  the frame as the file has it; NaN: missing
  /// @param living   per reading: the others are not looked at
  void add(std::span<const double> numbers, const std::vector<bool>& living) {
    for (std::size_t c = 0; c < channels_.size(); ++c)
      for (std::size_t i = channels_[c].first; i < channels_[c].first + channels_[c].count; ++i) {
        if (!living[i] || std::isnan(numbers[i])) continue;
        const double last = last_.empty() ? numbers[i] : last_[i];
        for (const std::size_t k : {0U, 1U}) {
          Found& found = found_[2 * c + k];
          if (!found.fits) continue;  // nor does it ever again
          found.add(numbers[i], last, codes[k]);
          crossings_[2 * i + k].add(numbers[i], last, codes[k]);
        }
      }
    last_.assign(numbers.begin(), numbers.end());
  }

  struct Lost {
    double codes = 0.0;     ///< 2^8 or 2^16
    std::size_t jumps = 0;  ///< from one end of them to the other
  };
  /// Of a channel: numbers are near both ends and jump from one to the other, and none is between.
  /// At each end there are several; or at one end a single number, which might stand for a value
  /// that is missing, but hardly ever follows a reading under load.
  [[nodiscard]] std::optional<Lost> lost(std::size_t channel) const {
    constexpr std::size_t least_jumps = 5;
    for (const std::size_t k : {0U, 1U})
      if (const Found& found = found_[2 * channel + k];
          found.fits && found.jumps >= least_jumps &&
          ((found.low > 0.0 && found.high < found.largest) || crosses_zero(channel, k)))
        return Lost{codes[k], found.jumps};
    return std::nullopt;
  }

 private:
  static constexpr double codes[] = {256.0, 65536.0};

  struct Found {
    void add(double number, double last, double of) {
      fits = fits && number >= 0.0 && number < of &&
             std::abs(number - std::round(number)) <= 1e-6 &&
             (number < 0.25 * of || number >= 0.75 * of);
      if (number < 0.25 * of)
        low = std::max(low, number);
      else
        high = std::min(high, number);
      largest = std::max(largest, number);
      if (std::abs(number - last) > 0.75 * of) ++jumps;
    }

    bool fits = true;
    double low = 0.0;  // the largest at the lower end
    double high = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    std::size_t jumps = 0;
  };

  /// One reading's jumps from the lower end to the upper.
  struct Crossings {
    void add(double number, double last, double of) {
      ++entries;
      if (std::min(number, of - number) > about_zero) ++loaded;
      if (!(number - last > 0.75 * of)) return;
      ++jumps;
      if (last + of - number > about_zero) ++jumps_under_load;
    }
    /// If they came at any time, under load as often as without.
    [[nodiscard]] double expected_under_load() const {
      return entries == 0 ? 0.0
                          : static_cast<double>(jumps) * static_cast<double>(loaded) /
                                static_cast<double>(entries);
    }

    static constexpr double about_zero = 4.0;  // steps: the noise of a coarse converter
    std::size_t entries = 0;
    std::size_t loaded = 0;  // entries farther from zero
    std::size_t jumps = 0;
    std::size_t jumps_under_load = 0;  // that are none without the sign, but large steps
  };

  /// Whether a channel's readings jump where they are about zero, as a code for missing values
  /// would not.
  [[nodiscard]] bool crosses_zero(std::size_t channel, std::size_t k) const {
    constexpr double enough = 10.0;  // of one reading: whole frames may be missing
    const Channel& of = channels_[channel];
    double expected = 0.0;
    double most = 0.0;
    double loaded = 0.0;
    for (std::size_t i = of.first; i < of.first + of.count; ++i) {
      const Crossings& one = crossings_[2 * i + k];
      expected += one.expected_under_load();
      most = std::max(most, one.expected_under_load());
      loaded += static_cast<double>(one.jumps_under_load);
    }
    return most >= enough && loaded <= 0.25 * expected;
  }

  std::vector<Channel> channels_;
  std::vector<Found> found_;          // per channel: of bytes, of twice as many bits
  std::vector<Crossings> crossings_;  // per reading, likewise
  std::vector<double> last_{};
};

}  // namespace tactile_net::lab
