#include "tactile_net/sensing/surface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "numeric/named.hpp"
#include "numeric/require.hpp"

namespace tactile_net {
namespace {

constexpr Named<SurfaceBasis> bases[] = {{SurfaceBasis::taxels, "taxels"},
                                         {SurfaceBasis::hats, "grid"}};

/// ceil, but for rounding.
double rounded_up(double ratio) { return std::ceil(ratio * (1.0 - 1e-12)); }

}  // namespace

std::string_view name(SurfaceBasis basis) noexcept { return name_in<bases>(basis); }

std::vector<double> positions(const Surface& surface) {
  std::vector<double> places;
  for (std::size_t i = 0; i < surface.count; ++i) places.push_back(surface.position(i));
  return places;
}

Surface surface_of(const SensorArray& array, const SurfaceOptions& options) {
  check(array);
  if (options.spacing) require_positive("spacing", *options.spacing);
  if (options.margin)
    require(*options.margin >= 0.0 && std::isfinite(*options.margin), "margin",
            "be >= 0 and finite", *options.margin);
  if (options.basis == SurfaceBasis::taxels)
    return {.basis = options.basis, .count = array.count, .spacing = array.pitch};

  const double depth = *std::min_element(array.depths.begin(), array.depths.end());
  const double wanted =
      options.spacing.value_or(array.pitch <= 0.5 * depth ? array.pitch : 0.25 * depth);
  const double stride = std::max(rounded_up(array.pitch / wanted), 1.0);
  const double spacing = array.pitch / stride;
  const double reach = rounded_up(options.margin.value_or(2.0 * depth) / spacing);
  const double margin = std::max(reach - 1.0, 0.0);  // the outermost hats end one spacing further
  const double count = static_cast<double>(array.count - 1) * stride + 2.0 * margin + 1.0;
  if (!(count <= static_cast<double>(most_values)))
    throw std::invalid_argument("the surface would have more than " + std::to_string(most_values) +
                                " values: choose a larger spacing or a smaller margin");
  return {.basis = options.basis,
          .count = static_cast<std::size_t>(count),
          .spacing = spacing,
          .area = 1.0 / stride,
          .centre = 0.0,
          .margin = static_cast<std::size_t>(margin),
          .stride = static_cast<std::size_t>(stride)};
}

}  // namespace tactile_net
