#include "tactile_net/sensing/array.hpp"

#include <algorithm>
#include <stdexcept>

#include "numeric/require.hpp"

namespace tactile_net {

void check(const SensorArray& array) {
  require(array.count >= 2, "count", "be >= 2", array.count);
  require_positive("pitch", array.pitch);
  if (array.depths.empty()) throw std::invalid_argument("depths must hold at least one value");
  for (const double depth : array.depths) require_positive("depth", depth);
  if (array.reads.empty()) throw std::invalid_argument("reads must hold at least one quantity");
  for (auto read = array.reads.begin(); read != array.reads.end(); ++read)
    if (std::find(array.reads.begin(), read, *read) != read)
      throw std::invalid_argument("reads must name a quantity once (got " +
                                  std::string(name(*read)) + " twice)");
}

double position(const SensorArray& array, std::size_t taxel) noexcept {
  return centred(taxel, array.count) * array.pitch;
}

std::vector<double> positions(const SensorArray& array) {
  std::vector<double> result;
  result.reserve(array.count);
  for (std::size_t j = 0; j < array.count; ++j) result.push_back(position(array, j));
  return result;
}

std::size_t channel_count(const SensorArray& array) noexcept {
  return array.reads.size() * array.depths.size();
}

std::size_t reading_count(const SensorArray& array) noexcept {
  return channel_count(array) * array.count;
}

std::vector<Channel> channels(const SensorArray& array) {
  std::vector<Channel> result;
  result.reserve(channel_count(array));
  for (const Quantity quantity : array.reads)
    for (std::size_t i = 0; i < array.depths.size(); ++i) {
      std::string label(name(quantity));
      if (array.depths.size() > 1) label += '@' + std::to_string(i);
      result.push_back({quantity, array.depths[i], std::move(label)});
    }
  return result;
}

std::vector<std::string> reading_names(const SensorArray& array) {
  std::vector<std::string> names;
  names.reserve(reading_count(array));
  for (const Channel& channel : channels(array))
    for (std::size_t taxel = 0; taxel < array.count; ++taxel)
      names.push_back(channel.name + "_" + std::to_string(taxel));
  return names;
}

}  // namespace tactile_net
