/// @file
/// Which presses to do next, and what each buys.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tactile_net/calibration/press_fit.hpp"

namespace tactile_net {

struct NextPress {
  Shape shape = Shape::cylinder;
  double position = 0.0;    ///< [m]
  double half_width = 0.0;  ///< [m]
  double radius = 0.0;      ///< of the rod that has this contact under this force [m]
  double force = 0.0;       ///< [N/m]
  double remaining = 0.0;   ///< of the criterion once this and those before are done
};

struct NextPresses {
  double now = 0.0;  ///< the criterion as it is
  std::vector<NextPress> presses{};
};

/// Chosen among places over the array, the narrowest, the middle and the widest contact of the log
/// and its largest force; greedily, then by exchange until nothing improves. What will be stated
/// of them is taken to be what the log states of its first press.
///
/// The criterion is what is unknown of readings under reference loads, cylinders everywhere on the
/// array: the rms of their standard deviations over the readings' rms. With a target it is that
/// parameter's standard deviation, of depth, thickness, E and pitch relative.
///
/// @param fit  of the same model, log and options
/// @throw std::invalid_argument  the target is not free; a skin: presses are planned on lines
[[nodiscard]] NextPresses next_presses(const PressModel& model, const PressLog& log,
                                       const CalibrationOptions& options, const PressFit& fit,
                                       std::size_t count, std::optional<PadParameter> target = {});

}  // namespace tactile_net
