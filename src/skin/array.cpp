#include "tactile_net/skin/array.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "numeric/require.hpp"
#include "skin/near_places.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {
namespace {

bool contains(const auto& values, const auto& value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

void check_reads(const std::vector<Quantity>& reads, const std::string& what) {
  if (reads.empty()) throw std::invalid_argument(what + " must hold at least one quantity");
  for (auto read = reads.begin(); read != reads.end(); ++read)
    if (std::find(reads.begin(), read, *read) != read)
      throw std::invalid_argument(what + " must name a quantity once (got " +
                                  std::string(name(*read)) + " twice)");
}

std::string label(const SkinTaxel& taxel, std::size_t index) {
  return taxel.name.empty() ? std::to_string(index) : taxel.name;
}

/// A name becomes a part of a CSV file's header.
void check_name(const std::string& text) {
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == ',' || c == '"' || c == 0x7f)
      throw std::invalid_argument(
          "the name of a taxel must hold no comma, quotation mark or control character");
}

void check(const std::vector<SkinTaxel>& taxels) {
  std::map<std::string, std::size_t> named;
  std::map<std::tuple<double, double, double, Quantity>, std::size_t> read;
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    const SkinTaxel& taxel = taxels[i];
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

/// The mean distance from a place to the nearest other one; the least depth if all are one place.
double mean_distance(const std::vector<SkinTaxel>& taxels, double alone) {
  const NearPlaces places{std::span(taxels)};
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    places.around(
        i, [&] { return nearest; },
        [&](std::size_t k) {
          const double distance = std::hypot(taxels[i].y - taxels[k].y, taxels[i].z - taxels[k].z);
          if (distance > 0.0) nearest = std::min(nearest, distance);
        });
    if (!std::isfinite(nearest)) continue;
    ++count;
    sum += (nearest - sum) / static_cast<double>(count);
  }
  return count > 0 ? sum : alone;
}

std::vector<Channel> even_channels(const SkinArray& skin) {
  std::vector<Channel> result;
  for (const Quantity quantity : skin.reads)
    for (std::size_t i = 0; i < skin.depths.size(); ++i) {
      std::string label(name(quantity));
      if (skin.depths.size() > 1) label += '@' + std::to_string(i);
      result.push_back({quantity, skin.depths[i], std::move(label),
                        result.size() * taxel_count(skin), taxel_count(skin)});
    }
  return result;
}

Site site(const SkinArray& skin, std::size_t taxel, const Channel& channel, std::size_t index) {
  if (!is_even(skin)) {
    const SkinTaxel& own = skin.taxels[taxel];
    return {own.y, own.z, own.depth, channel.quantity, taxel, index};
  }
  // A single row or column lies at 0, whatever its pitch.
  const auto place = [](std::size_t i, std::size_t count, double pitch) {
    return count == 1 ? 0.0 : centred(i, count) * pitch;
  };
  return {place(taxel / skin.columns, skin.rows, skin.pitch_y),
          place(taxel % skin.columns, skin.columns, skin.pitch_z),
          channel.depth,
          channel.quantity,
          taxel,
          index};
}

}  // namespace

SkinArray uneven_skin(std::vector<SkinTaxel> taxels) {
  if (taxels.empty()) throw std::invalid_argument("taxels must hold at least one taxel");
  check(taxels);
  SkinArray skin{.rows = taxels.size(), .columns = 1};
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    taxels[i].name = label(taxels[i], i);
    if (!contains(skin.depths, taxels[i].depth)) skin.depths.push_back(taxels[i].depth);
    for (const Quantity quantity : taxels[i].reads)
      if (!contains(skin.reads, quantity)) skin.reads.push_back(quantity);
  }
  skin.pitch_y = skin.pitch_z = mean_distance(taxels, least_depth(skin));
  skin.taxels = std::move(taxels);
  return skin;
}

void check(const SkinArray& skin) {
  if (!is_even(skin)) {
    check(skin.taxels);
    require(skin.rows == skin.taxels.size() && skin.columns == 1, "rows",
            "be as many as taxels, in one column: use uneven_skin", skin.rows);
    return;
  }
  require(skin.rows >= 1, "rows", "be >= 1", skin.rows);
  require(skin.columns >= 1, "columns", "be >= 1", skin.columns);
  if (skin.rows > 1) require_positive("pitch_y", skin.pitch_y);
  if (skin.columns > 1) require_positive("pitch_z", skin.pitch_z);
  if (skin.depths.empty()) throw std::invalid_argument("depths must hold at least one value");
  for (auto depth = skin.depths.begin(); depth != skin.depths.end(); ++depth) {
    require_positive("depth", *depth);
    require(std::find(skin.depths.begin(), depth, *depth) == depth, "depths",
            "be given once each, as two taxels at one place would read the same", *depth);
  }
  check_reads(skin.reads, "reads");
}

void check(const SkinArray& skin, const Material& material) {
  check(skin);
  check(material);
  if (!material.layer) return;
  const double base = material.layer->thickness;
  const std::string rule = "be at most the layer's thickness, " + shortest(base) +
                           ": below its base there is nothing to read";
  for (std::size_t i = 0; i < skin.taxels.size(); ++i)
    require(skin.taxels[i].depth <= base, "depth of taxel " + label(skin.taxels[i], i), rule,
            skin.taxels[i].depth);
  for (const double depth : skin.depths) require(depth <= base, "depth", rule, depth);
}

std::size_t channel_count(const SkinArray& skin) noexcept {
  return is_even(skin) ? skin.reads.size() * skin.depths.size() : skin.reads.size();
}

std::size_t reading_count(const SkinArray& skin) noexcept {
  if (is_even(skin)) return channel_count(skin) * taxel_count(skin);
  std::size_t count = 0;
  for (const SkinTaxel& taxel : skin.taxels) count += taxel.reads.size();
  return count;
}

std::vector<Channel> channels(const SkinArray& skin) {
  if (is_even(skin)) return even_channels(skin);
  std::vector<Channel> result;
  for (std::size_t first = 0; const Quantity quantity : skin.reads) {
    Channel channel{.quantity = quantity, .name = std::string(name(quantity)), .first = first};
    for (const SkinTaxel& taxel : skin.taxels) {
      if (!contains(taxel.reads, quantity)) continue;
      channel.depth = channel.count++ == 0 ? taxel.depth : std::min(channel.depth, taxel.depth);
    }
    first += channel.count;
    result.push_back(std::move(channel));
  }
  return result;
}

std::vector<Site> sites(const SkinArray& skin) {
  std::vector<Site> result;
  result.reserve(reading_count(skin));
  for (std::size_t c = 0; const Channel& channel : channels(skin)) {
    for (std::size_t i = 0; i < taxel_count(skin); ++i)
      if (is_even(skin) || contains(skin.taxels[i].reads, channel.quantity))
        result.push_back(site(skin, i, channel, c));
    ++c;
  }
  return result;
}

double least_depth(const SkinArray& skin) noexcept {
  return *std::min_element(skin.depths.begin(), skin.depths.end());
}

std::string taxel_name(const SkinArray& skin, std::size_t taxel) {
  if (!is_even(skin)) return label(skin.taxels[taxel], taxel);
  return std::to_string(taxel / skin.columns) + "_" + std::to_string(taxel % skin.columns);
}

std::vector<std::string> reading_names(const SkinArray& skin) {
  const std::vector<Channel> all = channels(skin);
  std::vector<std::string> names;
  for (const Site& site : sites(skin))
    names.push_back(all[site.channel].name + "_" + taxel_name(skin, site.taxel));
  return names;
}

}  // namespace tactile_net
