#include "lab/unseen_width.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/narrowest_seen.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/sensing/aperture.hpp"

namespace tactile_net::lab {
namespace {

using std::numbers::pi;

constexpr std::size_t neighbours_each_side = 4;  // of the gap: one of them sees most
constexpr int places_in_gap = 9;                 // from one end to the other

/// The live taxels about the widest gap, which is between numbers `gap` and `gap` + 1.
struct Neighbours {
  std::vector<double> y{};
  std::size_t gap = 0;
};

Neighbours about_widest_gap(const SensorArray& array, std::span<const std::size_t> dead_taxels) {
  std::vector<double> live;
  for (std::size_t i = 0; i < array.count; ++i)
    if (std::find(dead_taxels.begin(), dead_taxels.end(), i) == dead_taxels.end())
      live.push_back(position(array, i));
  if (live.size() < 2) return {live, 0};
  // Of equal gaps the one in the middle, which has most neighbours.
  std::size_t widest = (live.size() - 1) / 2;
  const auto width = [&](std::size_t i) { return live[i + 1] - live[i]; };
  for (std::size_t i = 0; i + 1 < live.size(); ++i)
    if (width(i) > width(widest) * (1.0 + 1e-9)) widest = i;
  const std::size_t first = widest - std::min(widest, neighbours_each_side - 1);
  const std::size_t last = std::min(widest + neighbours_each_side + 1, live.size());
  return {{live.begin() + static_cast<std::ptrdiff_t>(first),
           live.begin() + static_cast<std::ptrdiff_t>(last)},
          widest - first};
}

/// A strip's reading at the distance y from its middle, over its largest traction: the integral of
/// k(y - s) sqrt(1 - s^2 / a^2) by the Gauss rule of that weight.
double strip_reading(const PadKernel& kernel, const Aperture& aperture, double depth,
                     double half_width, double y) {
  const int n = 16 + static_cast<int>(8.0 * half_width / depth);
  double sum = 0.0;
  for (int i = 1; i <= n; ++i) {
    const double angle = pi * i / (n + 1.0);
    const double sine = std::sin(angle);
    sum += sine * sine * aperture.mean(kernel, y - half_width * std::cos(angle));
  }
  return pi * half_width / (n + 1.0) * sum;
}

}  // namespace

std::optional<double> unseen_width(const SensorArray& array, const Material& material,
                                   std::span<const double> channel_rms,
                                   std::span<const std::size_t> dead_taxels, double traction) {
  const Neighbours taxels = about_widest_gap(array, dead_taxels);
  if (taxels.y.size() < 2) return std::nullopt;
  // What is read about the gap; taxels that are alike share a kernel.
  struct Reading {
    double y, depth, rms;
    const PadKernel* kernel;
    Aperture aperture;
  };
  std::map<std::pair<Quantity, double>, PadKernel> kernels;
  std::vector<Reading> readings;
  for (const Site& site : sites(array)) {
    const bool dead =
        std::find(dead_taxels.begin(), dead_taxels.end(), site.taxel) != dead_taxels.end();
    if (dead || site.y < taxels.y.front() || site.y > taxels.y.back()) continue;
    const auto kernel = kernels.try_emplace({site.quantity, site.depth}, site.quantity,
                                            Traction::normal, material, site.depth);
    readings.push_back({site.y, site.depth, channel_rms[site.channel], &kernel.first->second,
                        Aperture(site.width, site.depth)});
  }

  const auto is_seen = [&](double half_width, double middle) {
    return std::any_of(readings.begin(), readings.end(), [&](const Reading& one) {
      return traction * std::abs(strip_reading(*one.kernel, one.aperture, one.depth, half_width,
                                               one.y - middle)) >
             one.rms;
    });
  };
  // Narrower ones cannot be seen anywhere: none gives more than its force as a line load above a
  // taxel where the kernel is largest.
  double least = std::numeric_limits<double>::infinity();
  for (const Reading& one : readings) {
    double peak = 0.0;
    for (int i = -40; i <= 40; ++i)
      peak = std::max(peak, std::abs(one.aperture.mean(*one.kernel, 0.05 * i * one.depth)));
    if (peak > 0.0) least = std::min(least, one.rms / (traction * 0.5 * pi * peak) / 1.1);
  }
  const double most = 0.5 * static_cast<double>(array.count) * array.pitch;

  double widest = 0.0;  // over the places
  const double from = taxels.y[taxels.gap];
  const double to = taxels.y[taxels.gap + 1];
  for (int place = 0; place < places_in_gap; ++place) {
    const double middle = std::lerp(from, to, place / (places_in_gap - 1.0));
    const auto seen = narrowest_seen(
        least, most, 1e-6, [&](double half_width) { return is_seen(half_width, middle); });
    if (!seen) return std::nullopt;
    widest = std::max(widest, *seen);
  }
  return 2.0 * widest;
}

}  // namespace tactile_net::lab
