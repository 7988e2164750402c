/// @file
/// The array of buried sensors: where the taxels are and what they read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// Equally spaced taxels along y, centred on y = 0, at one or several depths.
///
/// A vector of readings is channel after channel, each with `count` values; the channels are
/// quantity by quantity in the order of `reads`, each at every depth in the order of `depths`.
struct SensorArray {
  std::size_t count = 0;          ///< taxels along y, >= 2
  double pitch = 0.0;             ///< distance of neighbours [m], > 0
  std::vector<double> depths{};   ///< below the surface [m], each > 0, at least one
  std::vector<Quantity> reads{};  ///< at least one, none twice
};

/// One quantity at one depth.
struct Channel {
  Quantity quantity = Quantity::stress_x;
  double depth = 0.0;  ///< [m]
  std::string name{};  ///< "stress_x"; with several depths "stress_x@1" (index into `depths`)
};

/// @throw std::invalid_argument  a value is out of its range or not finite
void check(const SensorArray& array);

/// Place `index` of `count` equally spaced ones, in units of their distance, with 0 at the middle.
[[nodiscard]] constexpr double centred(std::size_t index, std::size_t count) noexcept {
  return static_cast<double>(index) - 0.5 * static_cast<double>(count - 1);
}

/// y of taxel j [m]: centred(j, count) * pitch.
[[nodiscard]] double position(const SensorArray& array, std::size_t taxel) noexcept;

/// y of every taxel [m], `count` values.
[[nodiscard]] std::vector<double> positions(const SensorArray& array);

/// Quantities times depths.
[[nodiscard]] std::size_t channel_count(const SensorArray& array) noexcept;

/// Values of one frame: channels times taxels.
[[nodiscard]] std::size_t reading_count(const SensorArray& array) noexcept;

/// Every channel, in the order of the readings.
[[nodiscard]] std::vector<Channel> channels(const SensorArray& array);

/// "strain_x_0" ... for every channel, in the order of the readings.
[[nodiscard]] std::vector<std::string> reading_names(const SensorArray& array);

}  // namespace tactile_net
