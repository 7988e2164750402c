/// @file
/// Taxels whose gain and zero drift with the temperature.
#pragma once

#include <memory>

#include "tactile_net/sensing/effects/effect.hpp"
#include "tactile_net/sensing/piecewise_linear.hpp"

namespace tactile_net {

/// reading -> (1 + gain dT) reading + offset dT, dT = `change` of the moment.
struct TemperatureDrift {
  double gain = 0.0;             ///< [1/K]
  PerQuantity<double> offset{};  ///< one for every quantity that is read [unit of the reading / K]
  PiecewiseLinear change{};      ///< from the temperature of calibration [K]
};

[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const TemperatureDrift& drift,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net
