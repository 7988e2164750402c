/// @file
/// The analog-to-digital converter.
#pragma once

#include <memory>

#include "tactile_net/sensing/effects/effect.hpp"
#include "tactile_net/sensing/effects/saturation.hpp"

namespace tactile_net {

/// Analog-to-digital converters of one width, a range for every quantity: readings become the
/// nearest of 2^bits levels, the lowest and the highest at the range's ends; those beyond saturate,
/// NaN stays NaN.
struct Quantization {
  int bits = 12;               ///< 1 ... 32
  PerQuantity<Range> range{};  ///< one for every quantity that is read [unit of the reading]
};

/// Distance of two levels [unit of the reading]. @pre  the quantity has a range
[[nodiscard]] double step(const Quantization& quantization, Quantity quantity);

/// Each frame says how many of its readings lay beyond the levels.
[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const Quantization& quantization,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
