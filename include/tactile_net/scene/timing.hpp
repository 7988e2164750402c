/// @file
/// When a scene's frames are taken: the table [time].
#pragma once

#include <cstddef>
#include <optional>

namespace tactile_net {

/// Frames at equal distances in time: frame k at t = k / rate.
struct Timing {
  double rate = 1.0;       ///< frames per second [1/s], > 0
  std::size_t frames = 1;  ///< >= 1

  [[nodiscard]] double time(std::size_t frame) const noexcept {
    return static_cast<double>(frame) / rate;
  }
};

/// @throw std::invalid_argument  there is no such frame
void check_frame(const std::optional<Timing>& time, std::size_t frame);

}  // namespace tactile_net
