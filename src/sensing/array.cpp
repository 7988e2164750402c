#include "tactile_net/sensing/array.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "numeric/require.hpp"
#include "tactile_net/sensing/aperture.hpp"

namespace tactile_net {
namespace {

void check_reads(const std::vector<Quantity>& reads) {
  if (reads.empty()) throw std::invalid_argument("reads must hold at least one quantity");
  for (auto read = reads.begin(); read != reads.end(); ++read) {
    check_line(*read);
    if (std::find(reads.begin(), read, *read) != read)
      throw std::invalid_argument("reads must name a quantity once (got " +
                                  std::string(name(*read)) + " twice)");
  }
}

bool contains(const auto& values, const auto& value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

void check_width(const std::string& name, double width, double depth) {
  require(width >= 0.0 && width <= Aperture::most_depths * depth, name,
          "be >= 0 and at most 10000 depths", width);
}

void check(const std::vector<Taxel>& taxels) {
  require(taxels.size() >= 2, "taxels", "be 2 at least", taxels.size());
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    const Taxel& taxel = taxels[i];
    const std::string which = "taxel " + std::to_string(i);
    require(std::isfinite(taxel.y), "y of " + which, "be finite", taxel.y);
    require_positive("depth of " + which, taxel.depth);
    check_width("width of " + which, taxel.width, taxel.depth);
    check_reads(taxel.reads);
    for (std::size_t j = i; j-- > 0 && taxels[j].y >= taxel.y;) {
      require(taxels[j].y == taxel.y, "y of " + which, "not be less than that of the one before",
              taxel.y);
      if (taxels[j].depth != taxel.depth) continue;
      for (const Quantity quantity : taxel.reads)
        if (contains(taxels[j].reads, quantity))
          throw std::invalid_argument("taxels " + std::to_string(j) + " and " + std::to_string(i) +
                                      " are at one place and read the same, " +
                                      std::string(name(quantity)));
    }
  }
}

std::vector<Channel> even_channels(const SensorArray& array) {
  std::vector<Channel> result;
  for (const Quantity quantity : array.reads)
    for (std::size_t i = 0; i < array.depths.size(); ++i) {
      std::string label(name(quantity));
      if (array.depths.size() > 1) label += '@' + std::to_string(i);
      result.push_back({quantity, array.depths[i], std::move(label), result.size() * array.count,
                        array.count, array.width});
    }
  return result;
}

}  // namespace

SensorArray uneven_array(std::vector<Taxel> taxels) {
  check(taxels);
  SensorArray array{.count = taxels.size()};
  for (const Taxel& taxel : taxels) {
    if (!contains(array.depths, taxel.depth)) array.depths.push_back(taxel.depth);
    for (const Quantity quantity : taxel.reads)
      if (!contains(array.reads, quantity)) array.reads.push_back(quantity);
  }
  array.pitch = (taxels.back().y - taxels.front().y) / static_cast<double>(taxels.size() - 1);
  if (array.pitch == 0.0) array.pitch = *std::min_element(array.depths.begin(), array.depths.end());
  array.taxels = std::move(taxels);
  return array;
}

void check(const SensorArray& array) {
  if (!is_even(array)) {
    check(array.taxels);
    require(array.count == array.taxels.size(), "count", "be that of the taxels: use uneven_array",
            array.count);
    return;
  }
  require(array.count >= 2, "count", "be >= 2", array.count);
  require_positive("pitch", array.pitch);
  if (array.depths.empty()) throw std::invalid_argument("depths must hold at least one value");
  for (const double depth : array.depths) {
    require_positive("depth", depth);
    check_width("width", array.width, depth);
  }
  check_reads(array.reads);
}

double position(const SensorArray& array, std::size_t taxel) noexcept {
  return is_even(array) ? centred(taxel, array.count) * array.pitch : array.taxels[taxel].y;
}

std::vector<double> positions(const SensorArray& array) {
  std::vector<double> result;
  result.reserve(array.count);
  for (std::size_t j = 0; j < array.count; ++j) result.push_back(position(array, j));
  return result;
}

std::size_t channel_count(const SensorArray& array) noexcept {
  return is_even(array) ? array.reads.size() * array.depths.size() : array.reads.size();
}

std::size_t reading_count(const SensorArray& array) noexcept {
  if (is_even(array)) return channel_count(array) * array.count;
  std::size_t count = 0;
  for (const Taxel& taxel : array.taxels) count += taxel.reads.size();
  return count;
}

std::vector<Channel> channels(const SensorArray& array) {
  if (is_even(array)) return even_channels(array);
  std::vector<Channel> result;
  for (std::size_t first = 0; const Quantity quantity : array.reads) {
    Channel channel{.quantity = quantity, .name = std::string(name(quantity)), .first = first};
    for (const Taxel& taxel : array.taxels) {
      if (!contains(taxel.reads, quantity)) continue;
      channel.depth = channel.count++ == 0 ? taxel.depth : std::min(channel.depth, taxel.depth);
    }
    first += channel.count;
    result.push_back(std::move(channel));
  }
  return result;
}

std::vector<Site> sites(const SensorArray& array) {
  std::vector<Site> result;
  result.reserve(reading_count(array));
  for (std::size_t c = 0; const Channel& channel : channels(array)) {
    for (std::size_t i = 0; i < array.count; ++i) {
      if (!is_even(array) && !contains(array.taxels[i].reads, channel.quantity)) continue;
      const auto [depth, width] = is_even(array)
                                      ? std::pair(channel.depth, channel.width)
                                      : std::pair(array.taxels[i].depth, array.taxels[i].width);
      result.push_back({.y = position(array, i),
                        .depth = depth,
                        .quantity = channel.quantity,
                        .taxel = i,
                        .channel = c,
                        .width = width});
    }
    ++c;
  }
  return result;
}

SensorArray every(const SensorArray& array, std::size_t stride) {
  if (!is_even(array)) {
    std::vector<Taxel> taxels;
    for (std::size_t i = 0; i < array.count; i += stride) taxels.push_back(array.taxels[i]);
    return uneven_array(std::move(taxels));
  }
  SensorArray result = array;
  result.count = (array.count - 1) / stride + 1;
  result.pitch *= static_cast<double>(stride);
  return result;
}

std::vector<std::string> reading_names(const SensorArray& array) {
  const std::vector<Channel> all = channels(array);
  std::vector<std::string> names;
  for (const Site& site : sites(array))
    names.push_back(all[site.channel].name + "_" + std::to_string(site.taxel));
  return names;
}

void require_even(const SensorArray& array, std::string_view asks) {
  if (!is_even(array))
    throw std::invalid_argument(std::string(asks) +
                                " needs taxels equally far apart, equally deep and alike");
}

}  // namespace tactile_net
