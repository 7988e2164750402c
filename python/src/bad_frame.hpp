/// @file
/// A frame that has no answer, as an error that says what is wrong with it.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "tactile_net/realtime/frame_status.hpp"

namespace tactile_net::python {

class BadFrame : public std::invalid_argument {
 public:
  BadFrame(const std::string& text, std::size_t frame) : invalid_argument(text), frame_(frame) {}
  /// Its number, from 0.
  [[nodiscard]] std::size_t frame() const noexcept { return frame_; }

 private:
  std::size_t frame_;
};

/// @param status  that the library gave it; not ok
[[nodiscard]] inline BadFrame bad_frame(FrameStatus status, std::span<const double> readings,
                                        std::size_t frame) {
  std::string text = "frame " + std::to_string(frame);
  if (status == FrameStatus::not_finite) {
    std::size_t i = 0;
    while (i + 1 < readings.size() && std::isfinite(readings[i])) ++i;
    text += ": reading " + std::to_string(i) + " is " +
            (std::isnan(readings[i]) ? "nan"
             : readings[i] > 0.0     ? "inf"
                                     : "-inf");
  } else if (status == FrameStatus::too_large) {
    text += ": its tractions may overflow a double; scale the readings";
  } else {
    text += ": " + std::string(name(status));
  }
  return {text, frame};
}

}  // namespace tactile_net::python
