/// @file
/// What a sensor's readings are of, a line array's or a skin's: which quantity, where, and whose.
#pragma once

#include <cstddef>
#include <string>

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// Readings of one quantity behind one another; of an even sensor, those at one depth.
struct Channel {
  Quantity quantity = Quantity::stress_x;
  double depth = 0.0;  ///< [m]; of taxels at several depths the least
  std::string name{};  ///< "stress_x"; of even sensors with several depths "stress_x@1" (index into
                       ///< their `depths`)
  std::size_t first = 0;  ///< index of its first reading
  std::size_t count = 0;  ///< readings
  double width = 0.0;     ///< of the taxels of an even line array [m]; of skins 0
};

/// Where and what one reading is of.
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
