/// @file
/// One reading through all frames of a recording, in a few numbers. Private.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace tactile_net {

/// The values at one end of a reading's range: how many are the outermost, and how many lie next
/// to it.
class RangeEnd {
 public:
  /// @param value  with the sign that makes the outermost the largest
  void add(double value) noexcept {
    if (value > outer_) {
      next_ = std::exchange(outer_, value);
      next_count_ = std::exchange(outer_count_, 1);
    } else if (value == outer_) {
      ++outer_count_;
    } else if (value > next_) {
      next_ = value;
      next_count_ = 1;
    } else if (value == next_) {
      ++next_count_;
    }
  }
  [[nodiscard]] double outermost() const noexcept { return outer_; }
  [[nodiscard]] std::size_t count() const noexcept { return outer_count_; }
  /// Whether values pile up there: noise, and what rises and falls, leave no more of the outermost
  /// than of the next.
  [[nodiscard]] bool piles_up(std::size_t least = 5, std::size_t times = 3) const noexcept {
    return outer_count_ >= least && outer_count_ > times * next_count_;
  }

 private:
  double outer_ = -std::numeric_limits<double>::infinity();
  double next_ = -std::numeric_limits<double>::infinity();
  std::size_t outer_count_ = 0;
  std::size_t next_count_ = 0;
};

class ReadingTrack {
 public:
  /// @param value  NaN: missing
  void add(double value, std::size_t frame) noexcept {
    if (std::isnan(value)) {
      ++missing_;
      return;
    }
    ++present_;
    high_.add(value);
    low_.add(-value);
    if (value == last_) {
      ++repeats_;
    } else {
      if (const double step = std::abs(value - last_); step < least_step_) least_step_ = step;
      run_ = 0;
      run_first_ = frame;
    }
    last_ = value;
    if (++run_ > longest_run_) {
      longest_run_ = run_;
      longest_first_ = run_first_;
    }
  }

  [[nodiscard]] std::size_t present() const noexcept { return present_; }
  [[nodiscard]] std::size_t missing() const noexcept { return missing_; }
  [[nodiscard]] double largest() const noexcept { return high_.outermost(); }
  [[nodiscard]] double least() const noexcept { return -low_.outermost(); }
  [[nodiscard]] bool is_constant() const noexcept { return repeats_ + 1 == present_; }
  [[nodiscard]] const RangeEnd& high() const noexcept { return high_; }
  [[nodiscard]] const RangeEnd& low() const noexcept { return low_; }
  /// The share of values that equal the one before.
  [[nodiscard]] double repeating() const noexcept {
    return present_ < 2 ? 0.0 : static_cast<double>(repeats_) / static_cast<double>(present_ - 1);
  }
  /// The least change from one value to the next that is not zero: a converter's step, if it has
  /// one that can be seen; infinite: there is no change.
  [[nodiscard]] double least_step() const noexcept { return least_step_; }
  /// The longest run of equal values, and the frame that it begins with.
  [[nodiscard]] std::size_t longest_run() const noexcept { return longest_run_; }
  [[nodiscard]] std::size_t run_begins() const noexcept { return longest_first_; }

 private:
  std::size_t present_ = 0;
  std::size_t missing_ = 0;
  std::size_t repeats_ = 0;
  RangeEnd high_;
  RangeEnd low_;
  double last_ = std::numeric_limits<double>::quiet_NaN();
  double least_step_ = std::numeric_limits<double>::infinity();
  std::size_t run_ = 0;
  std::size_t run_first_ = 0;
  std::size_t longest_run_ = 0;
  std::size_t longest_first_ = 0;
};

}  // namespace tactile_net
