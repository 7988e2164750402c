#include "tactile_net/skin/array.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "numeric/require.hpp"
#include "sensing/array_parts.hpp"
#include "skin/curved_kernel.hpp"
#include "skin/near_places.hpp"

namespace tactile_net {
namespace {

/// Taxels of an irregular skin.
void check(const std::vector<Taxel>& taxels) {
  if (taxels.empty()) throw std::invalid_argument("taxels must hold at least one taxel");
  check_taxels(taxels);
  for (std::size_t i = 0; i < taxels.size(); ++i)
    require(taxels[i].width == 0.0, "width of taxel " + label(taxels[i], i),
            "be 0 on a skin, whose taxels read at a point: leave the width out", taxels[i].width);
}

/// The mean distance from a place to the nearest other one; the least depth if all are one place.
double mean_distance(const std::vector<Taxel>& taxels, double alone) {
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

}  // namespace

SkinArray uneven_skin(std::vector<Taxel> taxels) {
  check(taxels);
  SkinArray skin{.rows = taxels.size(), .columns = 1};
  for (std::size_t i = 0; i < taxels.size(); ++i) taxels[i].name = label(taxels[i], i);
  take_taxels(skin, std::move(taxels));
  skin.pitch_y = skin.pitch_z = mean_distance(skin.taxels, least_depth(skin));
  return skin;
}

void require_flat(const SkinArray& skin, std::string_view asks) {
  if (skin.curved)
    throw std::invalid_argument(std::string(asks) +
                                " knows flat skins alone, and the surface of this one is curved");
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
  check_depths(skin.depths);
  check_reads(skin.reads, "reads");
}

void check(const SkinArray& skin, const Material& material) {
  check(skin);
  check(material);
  if (skin.curved) check_curved(skin, material);
  if (!material.layer) return;
  const double base = material.layer->thickness;
  const std::string rule = "be at most the layer's thickness, " + shortest(base) +
                           ": below its base there is nothing to read";
  for (std::size_t i = 0; i < skin.taxels.size(); ++i)
    require(skin.taxels[i].depth <= base, "depth of taxel " + label(skin.taxels[i], i), rule,
            skin.taxels[i].depth);
  for (const double depth : skin.depths) require(depth <= base, "depth", rule, depth);
}

std::size_t channel_count(const SkinArray& skin) noexcept { return count_channels(skin); }

std::size_t reading_count(const SkinArray& skin) noexcept { return count_readings(skin); }

std::vector<Channel> channels(const SkinArray& skin) { return list_channels(skin, 0.0); }

std::vector<Site> sites(const SkinArray& skin) {
  // A single row or column lies at 0, whatever its pitch.
  const auto along = [](std::size_t i, std::size_t count, double pitch) {
    return count == 1 ? 0.0 : centred(i, count) * pitch;
  };
  return list_sites(skin, [&](std::size_t taxel) {
    return std::pair(along(taxel / skin.columns, skin.rows, skin.pitch_y),
                     along(taxel % skin.columns, skin.columns, skin.pitch_z));
  });
}

double least_depth(const SkinArray& skin) noexcept {
  return *std::min_element(skin.depths.begin(), skin.depths.end());
}

std::string taxel_name(const SkinArray& skin, std::size_t taxel) {
  if (!is_even(skin)) return label(skin.taxels[taxel], taxel);
  return std::to_string(taxel / skin.columns) + "_" + std::to_string(taxel % skin.columns);
}

std::vector<std::string> reading_names(const SkinArray& skin) { return list_reading_names(skin); }

}  // namespace tactile_net
