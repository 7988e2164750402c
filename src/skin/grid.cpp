#include "tactile_net/skin/grid.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "sensing/axis_steps.hpp"
#include "skin/curved_kernel.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {
namespace {

/// From this depth on, in cells, a point load serves better than a rectangle.
constexpr double point_loads_from = 1.2;

/// Cells along one axis.
struct CellLine {
  double count;
  double spacing;
  double margin;
  double stride;  // 0: an irregular skin
};

/// Where an irregular skin's taxels lie along one axis.
struct TaxelRange {
  double from = 0.0;
  double to = 0.0;
};

TaxelRange taxel_range(const SkinArray& skin, double Taxel::*coordinate) {
  if (is_even(skin)) return {};
  const auto [least, largest] = std::minmax_element(
      skin.taxels.begin(), skin.taxels.end(),
      [&](const auto& a, const auto& b) { return a.*coordinate < b.*coordinate; });
  return {(*least).*coordinate, (*largest).*coordinate};
}

}  // namespace

SurfaceGrid grid_of(const SkinArray& skin, const SkinGridOptions& options) {
  check(skin);
  check_spacing_and_margin(options.spacing, options.margin);
  if (has_own_cells(skin)) return given_grid(skin);
  const double depth = least_depth(skin);
  const double margin = options.margin.value_or(depth);
  const auto [y_from, y_to] = taxel_range(skin, &Taxel::y);
  const auto [z_from, z_to] = taxel_range(skin, &Taxel::z);
  const auto line = [&](std::size_t taxels, double pitch, double extent) -> CellLine {
    const bool even = is_even(skin);
    const bool has_pitch = !even || taxels > 1;
    const double wanted =
        options.spacing.value_or(has_pitch ? std::min(pitch, 0.5 * depth) : 0.5 * depth);
    // From taxel to taxel of a regular skin, from the first to the last of an irregular one.
    const double gaps = even ? static_cast<double>(taxels - 1) : 1.0;
    const AxisSteps steps = steps_over(!even ? extent : taxels > 1 ? pitch : 0.0, wanted);
    const double outside = rounded_up(margin / steps.spacing);
    return {gaps * steps.count + 2.0 * outside + 1.0, steps.spacing, outside,
            even ? std::max(steps.count, 1.0) : 0.0};
  };
  const CellLine along_y = line(skin.rows, skin.pitch_y, y_to - y_from);
  const CellLine along_z = line(skin.columns, skin.pitch_z, z_to - z_from);
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
