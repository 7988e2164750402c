/// @file
/// Values of taxels, spread over the readings.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "numeric/require.hpp"
#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// The value of a quantity. @throw std::invalid_argument  there is none
template <typename T>
const T& value_of(const PerQuantity<T>& values, Quantity quantity, std::string_view what) {
  const auto found = values.find(quantity);
  if (found == values.end())
    throw std::invalid_argument(std::string(what) + " must name every quantity that is read (" +
                                std::string(name(quantity)) + " is missing)");
  return found->second;
}

/// @throw std::invalid_argument  not one value per taxel
inline void require_one_per_taxel(const std::vector<double>& values, const SignalLayout& sensor,
                                  const std::string& what) {
  require(values.size() == sensor.taxels, what, "hold one value per taxel", values.size());
}

/// @throw std::invalid_argument  a value is negative, infinite or NaN
inline void require_not_negative(const std::string& what, double value) {
  require(std::isfinite(value) && value >= 0.0, what, "be >= 0 and finite", value);
}

/// Which channel each reading is of.
inline std::vector<std::size_t> channel_of_readings(const SignalLayout& sensor) {
  std::vector<std::size_t> all;
  for (const Site& site : sensor.readings) all.push_back(site.channel);
  return all;
}

/// One value per reading, from one per quantity and taxel.
///
/// @throw std::invalid_argument  a quantity is missing, or has not one value per taxel
inline std::vector<double> of_readings(const PerQuantity<std::vector<double>>& values,
                                       const SignalLayout& sensor, const std::string& what) {
  std::vector<double> all;
  for (const Site& site : sensor.readings) {
    const std::vector<double>& own = value_of(values, site.quantity, what);
    require_one_per_taxel(own, sensor, what);
    all.push_back(own[site.taxel]);
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
