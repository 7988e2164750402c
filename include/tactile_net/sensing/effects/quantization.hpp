/// @file
/// The analog-to-digital converter.
#pragma once

#include <memory>
#include <span>

#include "tactile_net/sensing/effects/effect.hpp"
#include "tactile_net/sensing/effects/saturation.hpp"

namespace tactile_net {

/// An analog-to-digital converter: 2^bits levels, the lowest at `low`, the highest at `high`;
/// readings beyond them saturate, NaN stays NaN.
struct Converter {
  int bits = 12;      ///< 1 ... 32
  double low = 0.0;   ///< [unit of the readings]
  double high = 0.0;  ///< > low
};
/// Replaces readings by the nearest levels of a converter.
void quantize(std::span<double> readings, const Converter& converter) noexcept;

/// Converters of one width, a range for every quantity.
struct Quantization {
  int bits = 12;               ///< 1 ... 32
  PerQuantity<Range> range{};  ///< one for every quantity that is read [unit of the reading]
};

/// Distance of two levels [unit of the reading]. @pre  the quantity has a range
[[nodiscard]] double step(const Quantization& quantization, Quantity quantity);

/// Each frame says how many of its readings lay beyond the levels.
[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const Quantization& quantization,
                                                        const SignalLayout& sensor);

/// The stage of one converter for every quantity.
[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const Converter& converter,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
