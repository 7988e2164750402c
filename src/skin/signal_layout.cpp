#include "tactile_net/skin/signal_layout.hpp"

#include <algorithm>
#include <cmath>

namespace tactile_net {
namespace {

constexpr double reach = 1.3;  // between 1 and sqrt 2, the diagonal of a square

bool side_by_side(const SkinArray& skin, const SkinSite& a, const SkinSite& b) {
  if (is_even(skin)) {
    // b comes later.
    const bool next_column = b.taxel == a.taxel + 1 && b.taxel % skin.columns != 0;
    return next_column || b.taxel == a.taxel + skin.columns;
  }
  const double distance = std::hypot(a.y - b.y, a.z - b.z);
  return distance > 0.0 && distance <= reach * skin.pitch_y;
}

}  // namespace

SignalLayout signal_layout(const SkinArray& skin) {
  SignalLayout layout;
  layout.taxels = taxel_count(skin);
  const std::vector<SkinSite> all = sites(skin);
  std::vector<std::size_t> neighbours(all.size());
  for (const SkinChannel& channel : channels(skin)) {
    layout.channels.push_back({channel.quantity, channel.first, channel.count});
    const std::size_t end = channel.first + channel.count;
    for (std::size_t i = channel.first; i < end; ++i)
      for (std::size_t j = i + 1; j < end; ++j) {
        if (!side_by_side(skin, all[i], all[j])) continue;
        layout.neighbours.push_back({i, j});
        ++neighbours[i];
        ++neighbours[j];
      }
  }
  for (const SkinSite& site : all)
    layout.readings.push_back({site.quantity, site.taxel, site.channel});
  const std::size_t most = *std::max_element(neighbours.begin(), neighbours.end());
  layout.most_neighbours = std::max<std::size_t>(most, 1);
  return layout;
}

}  // namespace tactile_net
