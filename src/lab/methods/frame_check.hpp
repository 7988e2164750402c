/// @file
/// What every method asks of a frame before and after it is solved.
#pragma once

#include <algorithm>
#include <span>

#include "numeric/finite.hpp"
#include "tactile_net/realtime/frame_status.hpp"

namespace tactile_net::lab {

/// Whether a frame may be solved: its size and that of the room for its tractions, and its values.
inline FrameStatus check_frame(std::span<const double> readings, std::size_t expected,
                               std::span<const double> room, std::size_t tractions) noexcept {
  if (readings.size() != expected || room.size() != tractions) return FrameStatus::wrong_size;
  return all_finite(readings) ? FrameStatus::ok : FrameStatus::not_finite;
}

/// Copies an answer to where the caller wants it, unless it overflows a double.
inline FrameStatus deliver(std::span<const double> f, std::span<double> room) noexcept {
  if (!all_finite(f)) return FrameStatus::too_large;
  std::copy(f.begin(), f.end(), room.begin());
  return FrameStatus::ok;
}

}  // namespace tactile_net::lab
