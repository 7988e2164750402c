/// @file
/// A frame that has no answer, as an error that says what is wrong with it.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "tactile_net/lab/recording_solver.hpp"
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

/// @return  whether values are missing
/// @throw BadFrame  a reading is not finite, and not one that may miss
inline bool check_finite(std::span<const double> readings, std::size_t frame, bool may_miss) {
  bool incomplete = false;
  for (const double reading : readings) {
    if (std::isfinite(reading)) continue;
    incomplete = true;
    if (!may_miss || !std::isnan(reading))
      throw bad_frame(FrameStatus::not_finite, readings, frame);
  }
  return incomplete;
}

/// As the solver does. @throw BadFrame  the tractions overflow
[[nodiscard]] inline std::optional<lab::FrameAnswer> solved_frame(lab::RecordingSolver& solver,
                                                                  std::span<double> readings,
                                                                  std::optional<double> time,
                                                                  std::size_t frame) {
  try {
    return solver.solve(readings, time);
  } catch (const lab::FrameOverflow&) {
    throw bad_frame(FrameStatus::too_large, readings, frame);
  }
}

}  // namespace tactile_net::python
