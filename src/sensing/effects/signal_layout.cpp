#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net {

SignalLayout::SignalLayout(const SensorArray& array)
    : taxels(array.count), channels(tactile_net::channels(array)), readings(sites(array)) {
  for (const Channel& channel : channels)
    for (std::size_t i = 1; i < channel.count; ++i)
      neighbours.push_back({channel.first + i - 1, channel.first + i});
}

}  // namespace tactile_net
