#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net {

SignalQuantity::SignalQuantity(Quantity quantity) noexcept
    : value_(skin_quantity_named(name(quantity)).value_or(SkinQuantity::stress_x)) {}

SignalLayout::SignalLayout(const SensorArray& array) : taxels(array.count) {
  for (const Channel& channel : tactile_net::channels(array)) {
    channels.push_back({channel.quantity, channel.first, channel.count});
    for (std::size_t i = 1; i < channel.count; ++i)
      neighbours.push_back({channel.first + i - 1, channel.first + i});
  }
  for (const Site& site : sites(array))
    readings.push_back({site.quantity, site.taxel, site.channel});
}

}  // namespace tactile_net
