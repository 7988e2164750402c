/// @file
/// Frames that take time: each holds the mean over a window that ends with it.
#pragma once

#include <memory>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// The frame at time t holds the mean of the signal from t - aperture to t, exact for straight
/// lines between moments; `Instant::opens` tells where a window begins. Windows do not overlap. At
/// t = 0 the load, if it is one at once, has not acted yet.
struct Sampling {
  double aperture = 0.0;  ///< [s], >= 0, at most the time from frame to frame
};

[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const Sampling& sampling,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
