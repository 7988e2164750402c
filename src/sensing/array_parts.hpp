/// @file
/// What line arrays and skins share: taxels, and the order of their readings. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// A taxel's name; where it has none its index.
[[nodiscard]] std::string label(const Taxel& taxel, std::size_t index);

/// @param what  whose they are, for the message: "reads of taxel 3"
/// @throw std::invalid_argument  nothing is read, or something twice
void check_reads(const std::vector<Quantity>& reads, const std::string& what);

/// Taxels anywhere.
/// @throw std::invalid_argument  a place is not finite, a depth not > 0, nothing read or something
///                               twice, a name is not fit for a file's header; two have one name,
///                               or lie at one place and read the same
void check_taxels(const std::vector<Taxel>& taxels);

/// Depths of a regular array or skin.
/// @throw std::invalid_argument  there is none, one is not > 0, or given twice
void check_depths(const std::vector<double>& depths);

/// Fills in the depths and the quantities of an irregular array or skin, in the order in which
/// taxels first have them.
template <typename Array>
void take_taxels(Array& array, std::vector<Taxel> taxels) {
  const auto add = [](auto& values, const auto& value) {
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  };
  for (const Taxel& taxel : taxels) {
    add(array.depths, taxel.depth);
    for (const Quantity quantity : taxel.reads) add(array.reads, quantity);
  }
  array.taxels = std::move(taxels);
}

[[nodiscard]] inline bool is_read(const Taxel& taxel, Quantity quantity) noexcept {
  return std::find(taxel.reads.begin(), taxel.reads.end(), quantity) != taxel.reads.end();
}

template <typename Array>
[[nodiscard]] std::size_t count_channels(const Array& array) noexcept {
  return is_even(array) ? array.reads.size() * array.depths.size() : array.reads.size();
}

template <typename Array>
[[nodiscard]] std::size_t count_readings(const Array& array) noexcept {
  if (is_even(array)) return count_channels(array) * taxel_count(array);
  std::size_t count = 0;
  for (const Taxel& taxel : array.taxels) count += taxel.reads.size();
  return count;
}

/// @param width  of the taxels of a regular array
template <typename Array>
[[nodiscard]] std::vector<Channel> list_channels(const Array& array, double width) {
  std::vector<Channel> all;
  std::size_t first = 0;
  for (const Quantity quantity : array.reads) {
    const std::size_t depths = is_even(array) ? array.depths.size() : 1;
    for (std::size_t i = 0; i < depths; ++i) {
      Channel channel{.quantity = quantity, .name = std::string(name(quantity)), .first = first};
      if (is_even(array)) {
        channel.depth = array.depths[i];
        channel.count = taxel_count(array);
        channel.width = width;
        if (depths > 1) channel.name += '@' + std::to_string(i);
      }
      for (const Taxel& taxel : array.taxels)
        if (is_read(taxel, quantity))
          channel.depth = channel.count++ == 0 ? taxel.depth : std::min(channel.depth, taxel.depth);
      first += channel.count;
      all.push_back(std::move(channel));
    }
  }
  return all;
}

/// @param place  y and z of a taxel of a regular array [m]
template <typename Array, typename Place>
[[nodiscard]] std::vector<Site> list_sites(const Array& array, const Place& place) {
  std::vector<Site> all;
  all.reserve(reading_count(array));
  for (std::size_t c = 0; const Channel& channel : channels(array)) {
    for (std::size_t i = 0; i < taxel_count(array); ++i) {
      Site site{.quantity = channel.quantity, .taxel = i, .channel = c};
      if (is_even(array)) {
        std::tie(site.y, site.z) = place(i);
        site.depth = channel.depth;
        site.width = channel.width;
      } else {
        const Taxel& taxel = array.taxels[i];
        if (!is_read(taxel, channel.quantity)) continue;
        site.y = taxel.y;
        site.z = taxel.z;
        site.depth = taxel.depth;
        site.width = taxel.width;
      }
      all.push_back(site);
    }
    ++c;
  }
  return all;
}

template <typename Array>
[[nodiscard]] std::vector<std::string> list_reading_names(const Array& array) {
  const std::vector<Channel> all = channels(array);
  std::vector<std::string> names;
  for (const Site& site : sites(array))
    names.push_back(all[site.channel].name + "_" + taxel_name(array, site.taxel));
  return names;
}

}  // namespace tactile_net
