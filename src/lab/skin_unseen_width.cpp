#include "lab/skin_unseen_width.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "lab/narrowest_seen.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"

namespace tactile_net::lab {
namespace {

using std::numbers::pi;

constexpr std::size_t nearest_taxels = 12;  // of a place: one of them sees most

std::vector<SkinPlace> places_of(const SkinArray& skin) {
  std::vector<SkinPlace> places(taxel_count(skin));
  for (const Site& site : sites(skin)) places[site.taxel] = {site.y, site.z};
  return places;
}

double distance(const SkinPlace& a, const SkinPlace& b) { return std::hypot(a.y - b.y, a.z - b.z); }

/// Whether taxels lie around a place: no half of its horizon is without one.
bool lies_among(const SkinPlace& place, const std::vector<SkinPlace>& taxels) {
  std::vector<double> angles;
  for (const SkinPlace& taxel : taxels) {
    if (distance(place, taxel) == 0.0) return true;
    angles.push_back(std::atan2(taxel.z - place.z, taxel.y - place.y));
  }
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2.0 * pi - angles.back();
  for (std::size_t i = 0; i + 1 < angles.size(); ++i)
    widest = std::max(widest, angles[i + 1] - angles[i]);
  return widest <= pi * (1.0 + 1e-9);
}

/// One reading near the hole, of the normal traction.
struct NearReading {
  SkinPlace at;
  Quantity quantity;
  const SkinKernel* kernel;
  double depth;
  double rms;
};

/// Of a Hertz circle with a largest traction of 1, by rings: r = a sin t makes sqrt(1 - r^2 / a^2)
/// smooth. Two thirds of pi a^2 press.
double circle_reading(const NearReading& one, double radius, const SkinPlace& middle) {
  const int rings = 6 + static_cast<int>(2.0 * radius / one.depth);
  const int spokes = 8 * rings / 2;
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double t = 0.5 * pi * (i + 0.5) / rings;
    const double r = radius * std::sin(t);
    const double weight = std::cos(t) * std::cos(t) * std::sin(t);
    for (int j = 0; j < spokes; ++j) {
      const double angle = 2.0 * pi * (j + 0.5 * (i % 2)) / spokes;
      sum += weight * (*one.kernel)(one.quantity, Traction::normal,
                                    one.at.y - middle.y - r * std::cos(angle),
                                    one.at.z - middle.z - r * std::sin(angle));
    }
  }
  return sum * radius * radius * (0.5 * pi / rings) * (2.0 * pi / spokes);
}

}  // namespace

std::optional<SkinPlace> widest_hole(const SkinArray& skin,
                                     std::span<const std::size_t> dead_taxels) {
  const std::vector<SkinPlace> all = places_of(skin);
  std::vector<SkinPlace> live;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (std::find(dead_taxels.begin(), dead_taxels.end(), i) == dead_taxels.end())
      live.push_back(all[i]);
  if (live.size() < 2) return std::nullopt;
  const auto by_y = [](const auto& a, const auto& b) { return a.y < b.y; };
  const auto by_z = [](const auto& a, const auto& b) { return a.z < b.z; };
  const auto [top, bottom] = std::minmax_element(all.begin(), all.end(), by_y);
  const auto [left, right] = std::minmax_element(all.begin(), all.end(), by_z);
  const SkinPlace middle{0.5 * (top->y + bottom->y), 0.5 * (left->z + right->z)};
  // Twice as fine as the taxels: of a lattice the middles between four are among them.
  const auto steps = [](double length, double pitch) {
    return length > 0.0 ? static_cast<int>(std::lround(2.0 * length / pitch)) : 0;
  };
  const int rows = steps(bottom->y - top->y, skin.pitch_y);
  const int columns = steps(right->z - left->z, skin.pitch_z);
  std::optional<SkinPlace> hole;
  double widest = 0.0;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j <= columns; ++j) {
      const SkinPlace place{
          rows > 0 ? std::lerp(top->y, bottom->y, static_cast<double>(i) / rows) : top->y,
          columns > 0 ? std::lerp(left->z, right->z, static_cast<double>(j) / columns) : left->z};
      double room = std::numeric_limits<double>::infinity();
      for (const SkinPlace& taxel : live) room = std::min(room, distance(place, taxel));
      const bool wider = room > widest * (1.0 + 1e-9);
      const bool nearer = hole && room > widest * (1.0 - 1e-9) &&
                          distance(place, middle) < distance(*hole, middle) * (1.0 - 1e-9);
      if (!wider && !nearer) continue;
      if (!is_even(skin) && !lies_among(place, all)) continue;
      hole = place;
      widest = room;
    }
  return hole;
}

std::optional<double> skin_unseen_width(const SkinArray& skin, const Material& material,
                                        std::span<const double> channel_rms,
                                        std::span<const std::size_t> dead_taxels, double traction) {
  const std::optional<SkinPlace> hole = widest_hole(skin, dead_taxels);
  if (!hole) return std::nullopt;
  std::vector<Site> near;
  for (const Site& site : sites(skin))
    if (std::find(dead_taxels.begin(), dead_taxels.end(), site.taxel) == dead_taxels.end())
      near.push_back(site);
  const auto away = [&](const Site& site) { return distance({site.y, site.z}, *hole); };
  std::stable_sort(near.begin(), near.end(),
                   [&](const auto& a, const auto& b) { return away(a) < away(b); });
  const SkinPlace next{near.front().y, near.front().z};
  near.resize(std::min(near.size(), nearest_taxels * channel_count(skin)));
  std::map<double, SkinKernel> kernels;
  std::vector<NearReading> readings;
  for (const Site& site : near)
    readings.push_back({{site.y, site.z},
                        site.quantity,
                        &kernels.try_emplace(site.depth, material, site.depth).first->second,
                        site.depth,
                        channel_rms[site.channel]});

  const auto signal = [&](double radius, const SkinPlace& middle) {
    double most = 0.0;
    for (const NearReading& one : readings)
      most = std::max(most, traction * std::abs(circle_reading(one, radius, middle)) / one.rms);
    return most;
  };
  const std::vector<SkinPlace> all = places_of(skin);
  double most = 0.0;
  for (const SkinPlace& taxel : all) most = std::max(most, distance(taxel, *hole));
  double widest = 0.0;  // over places from the hole to the taxel next to it
  for (const double share : {0.0, 0.5, 1.0}) {
    const SkinPlace middle{std::lerp(hole->y, next.y, share), std::lerp(hole->z, next.z, share)};
    // A small one reads as its force does, by the square of its size.
    const double small = 1e-3 * least_depth(skin);
    const double least = small * 0.5 / std::sqrt(std::max(signal(small, middle), 1e-300));
    const auto seen = narrowest_seen(least, most, 1e-4,
                                     [&](double radius) { return signal(radius, middle) > 1.0; });
    if (!seen) return std::nullopt;
    widest = std::max(widest, *seen);
  }
  return 2.0 * widest;
}

}  // namespace tactile_net::lab
