/// @file
/// The times of a recording's frames, counted as they come. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "tactile_net/lab/readings_check.hpp"

namespace tactile_net::lab {

class ClockTrack {
 public:
  void add(std::optional<double> time, std::size_t frame) {
    if (!time) return;
    if (clock_.timed++ == 0) {
      clock_.first = *time;
    } else if (*time < clock_.last) {
      if (clock_.backwards++ == 0) clock_.first_backwards = frame;
      if (begins_anew(clock_.last, *time)) ++clock_.rollovers;
    } else if (*time == clock_.last) {
      if (clock_.repeats++ == 0) clock_.first_repeat = frame;
    } else {
      clock_.longest = std::max(clock_.longest, *time - clock_.last);
      clock_.forwards += *time - clock_.last;
    }
    clock_.last = *time;
  }
  [[nodiscard]] const RecordingClock& clock() const noexcept { return clock_; }

  void without_unit() noexcept { clock_.in_seconds = false; }

 private:
  /// A counter of 32 bits, of whatever unit, from its end to its begin.
  static bool begins_anew(double last, double next) noexcept {
    constexpr double count = 4294967296.0;
    for (const double unit : {1e-9, 1e-6, 1e-3, 1.0})
      if (const double end = count * unit;
          last < end && last > 15.0 / 16.0 * end && next >= 0.0 && next < end / 16.0)
        return true;
    return false;
  }

  RecordingClock clock_;
};

}  // namespace tactile_net::lab
