/// @file
/// Which quantity each reading of a sensor (a line array or a skin) is, where it is read, and by
/// which taxel.
#pragma once

#include <cstddef>
#include <string>

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// The readings of one quantity, which follow one another; of a regular sensor, those at one depth.
struct Channel {
  Quantity quantity = Quantity::stress_x;
  double depth = 0.0;  ///< [m]; the least, where taxels lie at several
  /// "stress_x"; of regular sensors with several depths "stress_x@1", an index into their `depths`.
  std::string name{};
  std::size_t first = 0;  ///< index of its first reading
  std::size_t count = 0;  ///< number of its readings
  double width = 0.0;     ///< of the taxels of a regular line array [m]; of skins 0
};

/// The place and the quantity of one reading.
struct Site {
  double y = 0.0;      ///< [m]
  double z = 0.0;      ///< [m]; of line arrays 0
  double depth = 0.0;  ///< [m]
  Quantity quantity = Quantity::stress_x;
  std::size_t taxel = 0;    ///< index along y; of a skin row * columns + column, or into `taxels`
  std::size_t channel = 0;  ///< index into the sensor's `channels`
  double width = 0.0;       ///< of the taxel of a line array [m]; of skins 0
};

}  // namespace tactile_net
