/// @file
/// Amplifiers that reach their limits.
#pragma once

#include <memory>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

struct Range {
  double low = 0.0;
  double high = 0.0;  ///< > low
};

/// Readings beyond the range stay at its end; each frame says how many do.
struct Saturation {
  PerQuantity<Range> range;  ///< one for every quantity that is read [unit of the reading]
};

[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const Saturation& saturation,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
