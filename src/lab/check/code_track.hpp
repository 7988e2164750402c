/// @file
/// The outermost numbers of a recording, as it has them: among them are codes for missing values.
/// Private.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::lab {

/// A number at the end of what a channel's readings are.
struct ExtremeNumber {
  double number = 0.0;      ///< raw
  std::size_t count = 0;    ///< of fields that hold it
  std::size_t reading = 0;  ///< the first of them
  bool several = false;     ///< other readings have it too
  std::size_t frames = 0;   ///< that hold nothing else
  std::size_t jumps = 0;    ///< how often a reading comes to it from another number
  std::size_t alone = 0;    ///< of these: the readings beside it hardly move, or come to it too
};

/// One end of a channel's numbers: the outermost different ones.
class ExtremeNumbers {
 public:
  static constexpr std::size_t most = 32;

  /// @param sign  1: the largest, -1: the least
  explicit ExtremeNumbers(double sign) : sign_(sign) {}

  /// @return  null: others are farther out. Valid until the next call
  ExtremeNumber* add(double number, std::size_t reading) {
    if (held_ == most && sign_ * number < sign_ * all_[most - 1].number) return nullptr;
    ExtremeNumber* const first = all_.data();
    ExtremeNumber* const end = first + held_;
    ExtremeNumber* const at = std::find_if(
        first, end, [&](const ExtremeNumber& one) { return sign_ * number >= sign_ * one.number; });
    if (at == end || at->number != number) {
      held_ = std::min(held_ + 1, most);
      ExtremeNumber* const last = first + held_ - 1;
      std::move_backward(at, last, last + 1);
      *at = {.number = number, .reading = reading};
    }
    ++at->count;
    at->several = at->several || at->reading != reading;
    return at;
  }
  /// A frame holds this number in every reading of the channel.
  void add_frame(double number) {
    for (std::size_t i = 0; i < held_; ++i)
      if (all_[i].number == number) ++all_[i].frames;
  }
  /// From the outermost inwards.
  [[nodiscard]] std::vector<ExtremeNumber> all() const {
    return {all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(held_)};
  }

 private:
  double sign_;
  std::array<ExtremeNumber, most> all_{};
  std::size_t held_ = 0;
};

/// Takes a recording frame by frame, in memory that does not grow with it.
class CodeTrack {
 public:
  struct Ends {
    ExtremeNumbers high{1.0};
    ExtremeNumbers low{-1.0};
    /// The least change from one number of a reading to its next; infinite: there is none.
    double step = std::numeric_limits<double>::infinity();
  };

  explicit CodeTrack(const SignalLayout& layout)
      : channels_(layout.channels), ends_(layout.channels.size()) {}

  /// @param numbers  the frame as the file has it; NaN: missing
  /// @param living   per reading: the others are not looked at
  void add(std::vector<double> numbers, const std::vector<bool>& living) {
    for (double& number : numbers) number = whole(number);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const std::size_t first = channels_[c].first;
      const std::size_t end = first + channels_[c].count;
      std::size_t present = 0;
      std::size_t same = 0;
      double only = 0.0;
      for (std::size_t i = first; i < end; ++i) {
        if (!living[i] || std::isnan(numbers[i])) continue;
        if (present++ == 0) only = numbers[i];
        if (numbers[i] == only) ++same;
        add(ends_[c], numbers, i, first, end);
      }
      if (present > 1 && same == present)
        for (ExtremeNumbers* one : {&ends_[c].high, &ends_[c].low}) one->add_frame(only);
    }
    last_ = std::move(numbers);
  }
  /// Per channel.
  [[nodiscard]] const std::vector<Ends>& ends() const noexcept { return ends_; }

 private:
  void add(Ends& ends, const std::vector<double>& numbers, std::size_t i, std::size_t first,
           std::size_t end) {
    const double jump = last_.empty() ? 0.0 : std::abs(numbers[i] - last_[i]);
    if (jump > 0.0) ends.step = std::min(ends.step, jump);
    const auto is_still = [&](std::size_t beside) {
      return beside < first || beside >= end || numbers[beside] == numbers[i] ||
             !(30.0 * std::abs(numbers[beside] - last_[beside]) >= jump);
    };
    for (ExtremeNumbers* side : {&ends.high, &ends.low}) {
      ExtremeNumber* const held = side->add(numbers[i], i);
      if (held == nullptr || !(jump > 0.0)) continue;
      ++held->jumps;
      if (is_still(i - 1) && is_still(i + 1)) ++held->alone;
    }
  }

  /// Without what rounding does on the way through a calibration and back.
  static double whole(double number) noexcept {
    const double nearest = std::round(number);
    return std::abs(number - nearest) <= 1e-9 * std::max(1.0, std::abs(nearest)) ? nearest : number;
  }

  std::vector<Channel> channels_;
  std::vector<Ends> ends_;
  std::vector<double> last_{};
};

}  // namespace tactile_net::lab
