#include "tactile_net/skin/signal_layout.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "skin/near_places.hpp"

namespace tactile_net {
namespace {

constexpr double reach = 1.3;  // between 1 and sqrt 2, the diagonal of a square

using Neighbours = SignalLayout::Neighbours;

/// Neighbours in a channel of a regular skin, by their places in it.
std::vector<Neighbours> on_lattice(const SkinArray& skin) {
  std::vector<Neighbours> all;
  const std::size_t taxels = taxel_count(skin);
  for (std::size_t i = 0; i < taxels; ++i) {
    if ((i + 1) % skin.columns != 0) all.push_back({i, i + 1});
    if (i + skin.columns < taxels) all.push_back({i, i + skin.columns});
  }
  return all;
}

/// Neighbours in a channel of an irregular skin.
std::vector<Neighbours> nearby(std::span<const Site> sites, double pitch) {
  const NearPlaces places(sites);
  std::vector<Neighbours> all;
  std::vector<std::size_t> later;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    later.clear();
    places.around(
        i, [&] { return reach * pitch; },
        [&](std::size_t j) {
          const double distance = std::hypot(sites[i].y - sites[j].y, sites[i].z - sites[j].z);
          if (j > i && distance > 0.0 && distance <= reach * pitch) later.push_back(j);
        });
    std::sort(later.begin(), later.end());
    for (const std::size_t j : later) all.push_back({i, j});
  }
  return all;
}

}  // namespace

SignalLayout signal_layout(const SkinArray& skin) {
  SignalLayout layout;
  layout.taxels = taxel_count(skin);
  layout.channels = channels(skin);
  layout.readings = sites(skin);
  std::vector<std::size_t> neighbours(layout.readings.size());
  for (const Channel& channel : layout.channels) {
    const auto own = std::span(layout.readings).subspan(channel.first, channel.count);
    for (const auto& [i, j] : is_even(skin) ? on_lattice(skin) : nearby(own, skin.pitch_y)) {
      layout.neighbours.push_back({channel.first + i, channel.first + j});
      ++neighbours[channel.first + i];
      ++neighbours[channel.first + j];
    }
  }
  const std::size_t most = *std::max_element(neighbours.begin(), neighbours.end());
  layout.most_neighbours = std::max<std::size_t>(most, 1);
  return layout;
}

}  // namespace tactile_net
