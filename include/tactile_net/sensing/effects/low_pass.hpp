/// @file
/// The bandwidth of taxels and their amplifiers.
#pragma once

#include <memory>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// time_constant out' = in - out: first order, with the cutoff frequency 1 / (2 pi time_constant).
/// Exact for inputs that are straight lines between moments.
struct LowPass {
  double time_constant = 0.0;  ///< [s], >= 0
};

[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const LowPass& low_pass,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
