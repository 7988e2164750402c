/// @file
/// What the signal path knows of a sensor, a line or a skin: which reading is of what and whose,
/// and which lie side by side.
#pragma once

#include <cstddef>
#include <vector>

#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/site.hpp"

namespace tactile_net {

struct SignalLayout {
  SignalLayout() = default;
  /// The layout of a line: a reading's neighbours are the one before and the one behind it in its
  /// channel.
  SignalLayout(const SensorArray& array);

  std::size_t taxels = 0;
  std::vector<Channel> channels{};
  std::vector<Site> readings{};
  /// Two readings of a channel whose taxels lie side by side.
  struct Neighbours {
    std::size_t first = 0;
    std::size_t second = 0;
  };
  std::vector<Neighbours> neighbours{};
  std::size_t most_neighbours = 2;  ///< largest number of neighbours of one reading
};

}  // namespace tactile_net
