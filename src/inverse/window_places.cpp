#include "inverse/window_places.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactile_net {
namespace {

using Eigen::Index;

constexpr double rounding = 1e-9;

/// One of a grid's two.
struct WindowAxis {
  Index values = 0;
  double spacing = 0.0;
  Index margin = 0;
  bool hats = false;  // they fall to 0 one spacing beyond: they are one less than spacings

  [[nodiscard]] double length() const {
    return static_cast<double>(hats ? values + 1 : values) * spacing;
  }
  [[nodiscard]] Index count(double width) const {
    // The same in any unit, also where it is halfway between two.
    return std::clamp<Index>(std::lround(width / spacing * (1.0 + rounding)) - (hats ? 1 : 0), 1,
                             values);
  }
};

/// @param apart  [m]
std::vector<AxisRange> places_on(const WindowAxis& axis, Index count, double apart) {
  const Index n = axis.values;
  if (count == n) return {{0, n}};
  const double step = std::max(apart / axis.spacing, 1.0);
  const double steps = static_cast<double>(n - count) / step;
  Index places = static_cast<Index>(std::ceil(steps * (1.0 - rounding))) + 1;
  // No window lies in the very middle where the values left over are odd: two are beside it.
  if (places % 2 == 1 && (n - count) % 2 == 1) ++places;
  const auto to_array = static_cast<double>(axis.margin);
  const auto last = static_cast<double>(n - 1);
  std::vector<AxisRange> all;
  for (Index k = 0; k < places; ++k) {
    const Index from_end = (n - count) * std::min(k, places - 1 - k) / (places - 1);
    const Index first = 2 * k < places ? from_end : n - count - from_end;  // a mirrored array's
    const double middle = static_cast<double>(first) + 0.5 * static_cast<double>(count - 1);
    if (middle >= to_array && middle <= last - to_array) all.push_back({first, count});
  }
  return all;
}

}  // namespace

std::vector<std::vector<WindowPlace>> window_levels(const SurfaceGrid& grid, double narrowest,
                                                    const WindowSteps& steps, bool is_line) {
  const auto axis = [](std::size_t values, double spacing, std::size_t margin, Boundary boundary) {
    return WindowAxis{.values = static_cast<Index>(values),
                      .spacing = spacing,
                      .margin = static_cast<Index>(margin),
                      .hats = boundary == Boundary::zero_beyond};
  };
  const WindowAxis y = axis(grid.rows, grid.spacing_y, grid.margin_rows, grid.boundary_y);
  const WindowAxis z = axis(grid.columns, grid.spacing_z, grid.margin_columns, grid.boundary_z);
  const double whole = is_line ? y.length() : std::max(y.length(), z.length());
  const double fine = std::max({steps.step, y.spacing, z.spacing});
  std::vector<std::vector<WindowPlace>> levels;
  std::size_t widths = 0;
  for (double width = narrowest; width < whole && widths < steps.most_widths;) {
    const bool is_narrow = width < steps.wide * (1.0 - rounding);
    const Index rows = y.count(width);
    const Index columns = is_line ? 1 : z.count(width);
    if (rows == y.values && columns == z.values) break;
    const double apart = is_narrow ? fine : steps.apart * width;
    std::vector<WindowPlace> level;
    const std::vector<AxisRange> across = places_on(z, columns, apart);
    for (const AxisRange& down : places_on(y, rows, apart))
      for (const AxisRange& range : across) level.push_back({down, range});
    if (!level.empty()) {
      levels.push_back(std::move(level));
      widths += is_narrow ? 0 : 1;
    }
    width = is_narrow ? std::min(width + fine, steps.wide) : width * steps.wider;
  }
  levels.push_back({{{0, y.values}, {0, z.values}}});
  return levels;
}

}  // namespace tactile_net
