#include "tactile_net/sensing/array.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "numeric/require.hpp"
#include "sensing/array_parts.hpp"
#include "tactile_net/sensing/aperture.hpp"

namespace tactile_net {
namespace {

/// A name becomes a part of a CSV file's header.
void check_name(const std::string& text) {
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == ',' || c == '"' || c == 0x7f)
      throw std::invalid_argument(
          "the name of a taxel must hold no comma, quotation mark or control character");
}

void check_width(const std::string& name, double width, double depth) {
  require(width >= 0.0 && width <= Aperture::most_depths * depth, name,
          "be >= 0 and at most 10000 depths", width);
}

void check_plane(const std::vector<Quantity>& reads) {
  for (const Quantity quantity : reads) check_line(quantity);
}

void check(const std::vector<Taxel>& taxels) {
  require(taxels.size() >= 2, "taxels", "be 2 at least", taxels.size());
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    const std::string which = "taxel " + label(taxels[i], i);
    require(taxels[i].z == 0.0, "z of " + which,
            "be 0 on a line array: make a skin of taxels that lie beside each other, uneven_skin",
            taxels[i].z);
    check_plane(taxels[i].reads);
  }
  check_taxels(taxels);
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    const std::string which = "taxel " + label(taxels[i], i);
    check_width("width of " + which, taxels[i].width, taxels[i].depth);
    require(i == 0 || taxels[i].y >= taxels[i - 1].y, "y of " + which,
            "not be less than that of the one before", taxels[i].y);
  }
}

}  // namespace

std::string label(const Taxel& taxel, std::size_t index) {
  return taxel.name.empty() ? std::to_string(index) : taxel.name;
}

void check_reads(const std::vector<Quantity>& reads, const std::string& what) {
  if (reads.empty()) throw std::invalid_argument(what + " must hold at least one quantity");
  for (auto read = reads.begin(); read != reads.end(); ++read)
    if (std::find(reads.begin(), read, *read) != read)
      throw std::invalid_argument(what + " must name a quantity once (got " +
                                  std::string(name(*read)) + " twice)");
}

void check_taxels(const std::vector<Taxel>& taxels) {
  std::map<std::string, std::size_t> named;
  std::map<std::tuple<double, double, double, Quantity>, std::size_t> read;
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    const Taxel& taxel = taxels[i];
    check_name(taxel.name);
    const std::string which = "taxel " + label(taxel, i);
    require_finite("y of " + which, taxel.y);
    require_finite("z of " + which, taxel.z);
    require_positive("depth of " + which, taxel.depth);
    check_reads(taxel.reads, "reads of " + which);
    if (const auto [same, is_new] = named.emplace(label(taxel, i), i); !is_new)
      throw std::invalid_argument("taxels " + std::to_string(same->second) + " and " +
                                  std::to_string(i) + " have one name, " + same->first +
                                  ": a reading must be told from another");
    for (const Quantity quantity : taxel.reads) {
      // -0 and 0 are one place.
      const auto place = std::tuple(taxel.y + 0.0, taxel.z + 0.0, taxel.depth, quantity);
      if (const auto [same, is_new] = read.emplace(place, i); !is_new)
        throw std::invalid_argument(
            "taxels " + label(taxels[same->second], same->second) + " and " + label(taxel, i) +
            " are at one place, y = " + shortest(taxel.y) + ", z = " + shortest(taxel.z) +
            ", and read the same, " + std::string(name(quantity)) +
            ": leave one out, or average their readings");
    }
  }
}

void check_depths(const std::vector<double>& depths) {
  if (depths.empty()) throw std::invalid_argument("depths must hold at least one value");
  for (auto depth = depths.begin(); depth != depths.end(); ++depth) {
    require_positive("depth", *depth);
    require(std::find(depths.begin(), depth, *depth) == depth, "depths",
            "be given once each, as two taxels at one place would read the same", *depth);
  }
}

SensorArray uneven_array(std::vector<Taxel> taxels) {
  check(taxels);
  SensorArray array{.count = taxels.size()};
  array.pitch = (taxels.back().y - taxels.front().y) / static_cast<double>(taxels.size() - 1);
  take_taxels(array, std::move(taxels));
  if (array.pitch == 0.0) array.pitch = least_depth(array);
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
  check_depths(array.depths);
  for (const double depth : array.depths) check_width("width", array.width, depth);
  check_reads(array.reads, "reads");
  check_plane(array.reads);
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

std::size_t channel_count(const SensorArray& array) noexcept { return count_channels(array); }

std::size_t reading_count(const SensorArray& array) noexcept { return count_readings(array); }

std::vector<Channel> channels(const SensorArray& array) {
  return list_channels(array, array.width);
}

std::vector<Site> sites(const SensorArray& array) {
  return list_sites(array,
                    [&](std::size_t taxel) { return std::pair(position(array, taxel), 0.0); });
}

double least_depth(const SensorArray& array) noexcept {
  return *std::min_element(array.depths.begin(), array.depths.end());
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

std::string taxel_name(const SensorArray& array, std::size_t taxel) {
  return is_even(array) ? std::to_string(taxel) : label(array.taxels[taxel], taxel);
}

std::vector<std::string> reading_names(const SensorArray& array) {
  return list_reading_names(array);
}

void require_even(const SensorArray& array, std::string_view asks) {
  if (!is_even(array))
    throw std::invalid_argument(std::string(asks) +
                                " needs taxels equally far apart, equally deep and alike");
}

}  // namespace tactile_net
