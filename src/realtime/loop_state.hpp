/// @file
/// What an estimator keeps for the loop that calls it, from frame to frame. Private.
#pragma once

#include <array>
#include <cstddef>

#include "realtime/aligned.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

struct LoopState {
  LoopState(std::size_t readings, std::size_t tractions)
      : converted(readings), held_tractions(tractions) {}

  void count(FrameStatus status) noexcept {
    ++counters.frames;
    if (status != FrameStatus::ok) count_refused(status);
  }
  /// Ends a frame of `update`.
  void close(FrameStatus status, ContactEstimate& estimate) noexcept {
    count(status);
    if (options.hold) hold(status, estimate);
  }

  LoopOptions options;
  FrameCounters counters;
  Aligned<double> converted;  // readings that came as other numbers
  // The last good answer of `update`, while answers are held.
  Aligned<double> held_tractions;
  std::array<ContactRow, most_contact_rows> held_rows;
  ContactEstimate held;
  bool has_held = false;

 private:
  void count_refused(FrameStatus status) noexcept;
  void hold(FrameStatus status, ContactEstimate& estimate) noexcept;
};

}  // namespace tactile_net
