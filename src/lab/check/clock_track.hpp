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
    } else if (*time == clock_.last) {
      if (clock_.repeats++ == 0) clock_.first_repeat = frame;
    } else {
      clock_.longest = std::max(clock_.longest, *time - clock_.last);
    }
    clock_.last = *time;
  }
  [[nodiscard]] const RecordingClock& clock() const noexcept { return clock_; }

 private:
  RecordingClock clock_;
};

}  // namespace tactile_net::lab
