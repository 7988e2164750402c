/// @file
/// Which presses to do next, and what each buys.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "tactile_net/calibration/press_fit.hpp"

namespace tactile_net {

struct NextPress {
  Shape shape = Shape::cylinder;  ///< on a line
  double position = 0.0;          ///< y [m]
  double half_width = 0.0;        ///< of the contact [m]
  double radius = 0.0;      ///< of the rod or ball with this contact under `force` [m]; 0: neither
  double force = 0.0;       ///< [N/m], on a skin [N]
  double remaining = 0.0;   ///< the criterion once this and those before are done
  double position_z = 0.0;  ///< on a skin [m]
  DiscProfile disc = DiscProfile::sphere;  ///< on a skin
};

struct NextPresses {
  double now = 0.0;  ///< the criterion before any of them
  std::vector<NextPress> presses{};
};

/// The presses that tell most next: chosen greedily, then by exchange until nothing improves. On a
/// line among places over the array, the narrowest, the middle and the widest contact of the log,
/// and its largest force. On a skin among a grid of places, the indenters that had these contacts,
/// and the largest force and half of it. What will be stated of them is taken to be what the log
/// states of its first press; they go straight down.
///
/// The criterion is what is unknown of readings under reference loads, cylinders everywhere on the
/// array, on a skin the same indenters all over it: the rms of their standard deviations over the
/// readings' rms. With a target it is that parameter's standard deviation, of depth, thickness, E
/// and pitch relative.
///
/// One search is O(candidates readings^3): on skins of 200 readings some seconds.
///
/// @param fit    the fit of this model, log and options
/// @param watch  called before every search with its number, from 1; may throw
/// @throw std::invalid_argument  the target is not free; something is not known at all
[[nodiscard]] NextPresses next_presses(const PressModel& model, const PressLog& log,
                                       const CalibrationOptions& options, const PressFit& fit,
                                       std::size_t count, std::optional<PadParameter> target = {},
                                       const std::function<void(std::size_t)>& watch = {});

}  // namespace tactile_net
