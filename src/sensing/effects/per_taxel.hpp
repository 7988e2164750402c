/// @file
/// Values of taxels, spread over the readings.
#pragma once

#include <algorithm>
#include <vector>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// One value per reading, channels x count, from one per quantity and taxel.
inline std::vector<double> of_readings(const PerQuantity<std::vector<double>>& values,
                                       const SensorArray& array) {
  std::vector<double> all;
  for (const Channel& channel : channels(array)) {
    const std::vector<double>& own = values.at(channel.quantity);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

inline bool all_zero(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; });
}

inline bool all_zero(const PerQuantity<std::vector<double>>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](const auto& one) { return all_zero(one.second); });
}

}  // namespace tactile_net
