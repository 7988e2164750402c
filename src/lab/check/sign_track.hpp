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
      : channels_(layout.channels), found_(2 * layout.channels.size()) {}

  /// @param numbers  the frame as the file has it; NaN: missing
  /// @param living   per reading: the others are not looked at
  void add(std::span<const double> numbers, const std::vector<bool>& living) {
    for (std::size_t c = 0; c < channels_.size(); ++c)
      for (std::size_t i = channels_[c].first; i < channels_[c].first + channels_[c].count; ++i) {
        if (!living[i] || std::isnan(numbers[i])) continue;
        const double last = last_.empty() ? numbers[i] : last_[i];
        for (const std::size_t k : {0U, 1U}) found_[2 * c + k].add(numbers[i], last, codes[k]);
      }
    last_.assign(numbers.begin(), numbers.end());
  }

  struct Lost {
    double codes = 0.0;     ///< 2^8 or 2^16
    std::size_t jumps = 0;  ///< from one end of them to the other
  };
  /// Of a channel: numbers are near both ends, several at each, and jump from one to the other, and
  /// none is between.
  [[nodiscard]] std::optional<Lost> lost(std::size_t channel) const {
    constexpr std::size_t least_jumps = 5;
    for (const std::size_t k : {0U, 1U})
      if (const Found& found = found_[2 * channel + k];
          found.fits && found.jumps >= least_jumps && found.low > 0.0 && found.high < found.largest)
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

  std::vector<SignalChannel> channels_;
  std::vector<Found> found_;  // per channel: of bytes, of twice as many bits
  std::vector<double> last_{};
};

}  // namespace tactile_net::lab
