#include "tactile_net/skin/grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "numeric/require.hpp"

namespace tactile_net {
namespace {

/// From this depth on, in cells, a point load serves better than a rectangle.
constexpr double point_loads_from = 1.2;

/// ceil, but for rounding.
double rounded_up(double ratio) { return std::ceil(ratio * (1.0 - 1e-12)); }

/// Cells along one axis.
struct Line {
  double count;
  double spacing;
  double margin;
  double stride;  // 0: an irregular skin
};

/// @param wanted  spacing and margin [m], at most and at least
Line even_line(std::size_t taxels, double pitch, double spacing, double margin) {
  const double stride = taxels > 1 ? std::max(rounded_up(pitch / spacing), 1.0) : 1.0;
  const double own = taxels > 1 ? pitch / stride : spacing;
  const double outside = rounded_up(margin / own);
  return {static_cast<double>(taxels - 1) * stride + 2.0 * outside + 1.0, own, outside, stride};
}

Line uneven_line(double length, double spacing, double margin) {
  const double steps = length > 0.0 ? std::max(rounded_up(length / spacing), 1.0) : 0.0;
  const double own = length > 0.0 ? length / steps : spacing;
  const double outside = rounded_up(margin / own);
  return {steps + 2.0 * outside + 1.0, own, outside, 0.0};
}

/// Where an irregular skin's taxels lie along one axis.
struct Extent {
  double from = 0.0;
  double to = 0.0;
};

Extent extent(const SkinArray& skin, double SkinTaxel::*coordinate) {
  if (is_even(skin)) return {};
  const auto [least, largest] = std::minmax_element(
      skin.taxels.begin(), skin.taxels.end(),
      [&](const auto& a, const auto& b) { return a.*coordinate < b.*coordinate; });
  return {(*least).*coordinate, (*largest).*coordinate};
}

}  // namespace

SurfaceGrid grid_of(const SkinArray& skin, const SkinGridOptions& options) {
  check(skin);
  if (options.spacing) require_positive("spacing", *options.spacing);
  if (options.margin)
    require(*options.margin >= 0.0 && std::isfinite(*options.margin), "margin",
            "be >= 0 and finite", *options.margin);
  const double depth = least_depth(skin);
  const double margin = options.margin.value_or(depth);
  const auto [y_from, y_to] = extent(skin, &SkinTaxel::y);
  const auto [z_from, z_to] = extent(skin, &SkinTaxel::z);
  const auto line = [&](std::size_t taxels, double pitch, double length) {
    const bool has_pitch = !is_even(skin) || taxels > 1;
    const double spacing =
        options.spacing.value_or(has_pitch ? std::min(pitch, 0.5 * depth) : 0.5 * depth);
    return is_even(skin) ? even_line(taxels, pitch, spacing, margin)
                         : uneven_line(length, spacing, margin);
  };
  const Line along_y = line(skin.rows, skin.pitch_y, y_to - y_from);
  const Line along_z = line(skin.columns, skin.pitch_z, z_to - z_from);
  if (!(along_y.count * along_z.count <= static_cast<double>(most_cells)))
    throw std::invalid_argument("the surface would have " + shortest(along_y.count) + " x " +
                                shortest(along_z.count) + " cells, more than " +
                                std::to_string(most_cells) +
                                ": choose a larger spacing or a smaller margin");
  return {.rows = static_cast<std::size_t>(along_y.count),
          .columns = static_cast<std::size_t>(along_z.count),
          .spacing_y = along_y.spacing,
          .spacing_z = along_z.spacing,
          .centre_y = y_from + 0.5 * (y_to - y_from),
          .centre_z = z_from + 0.5 * (z_to - z_from),
          .margin_rows = static_cast<std::size_t>(along_y.margin),
          .margin_columns = static_cast<std::size_t>(along_z.margin),
          .stride_rows = static_cast<std::size_t>(along_y.stride),
          .stride_columns = static_cast<std::size_t>(along_z.stride),
          .rectangles = depth < point_loads_from * std::max(along_y.spacing, along_z.spacing)};
}

}  // namespace tactile_net
