#include "tactile_net/sensing/surface.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "numeric/named.hpp"
#include "sensing/axis_steps.hpp"

namespace tactile_net {
namespace {

constexpr Named<SurfaceBasis> bases[] = {{SurfaceBasis::taxels, "taxels"},
                                         {SurfaceBasis::hats, "grid"}};

/// Between neighbours [m].
double widest_gap(const SensorArray& array) noexcept {
  if (is_even(array)) return array.pitch;
  double widest = 0.0;
  for (std::size_t i = 1; i < array.count; ++i)
    widest = std::max(widest, array.taxels[i].y - array.taxels[i - 1].y);
  return widest;
}

}  // namespace

std::string_view name(SurfaceBasis basis) noexcept { return name_in<bases>(basis); }

std::vector<double> positions(const Surface& surface) {
  std::vector<double> places;
  for (std::size_t i = 0; i < surface.count; ++i) places.push_back(surface.position(i));
  return places;
}

SurfaceGrid grid_of(const Surface& surface) noexcept {
  return {.rows = surface.count,
          .columns = 1,
          .spacing_y = surface.spacing,
          .spacing_z = 1.0,
          .centre_y = surface.centre,
          .margin_rows = surface.margin,
          .stride_rows = surface.stride,
          .stride_columns = 1,
          .boundary_y =
              surface.basis == SurfaceBasis::hats ? Boundary::zero_beyond : Boundary::neumann};
}

Surface surface_of(const SurfaceGrid& grid) noexcept {
  return {
      .basis = grid.boundary_y == Boundary::zero_beyond ? SurfaceBasis::hats : SurfaceBasis::taxels,
      .count = grid.rows,
      .spacing = grid.spacing_y,
      .centre = grid.centre_y,
      .margin = grid.margin_rows,
      .stride = grid.stride_rows};
}

double measure_of(const SensorArray& array, const Surface& surface) noexcept {
  return is_even(array) ? 1.0 / static_cast<double>(surface.stride) : surface.spacing / array.pitch;
}

bool is_dense(const SensorArray& array) noexcept {
  return widest_gap(array) <= 0.5 * least_depth(array);
}

SurfaceOptions one_value_per_taxel(const SensorArray& array) noexcept {
  if (is_even(array)) return {};
  return {.basis = SurfaceBasis::hats, .spacing = array.pitch, .margin = 0.0};
}

Surface surface_of(const SensorArray& array, const SurfaceOptions& options) {
  check(array);
  check_spacing_and_margin(options.spacing, options.margin);
  if (options.basis == SurfaceBasis::taxels) {
    require_even(array, "a line load over each taxel");
    return {.basis = options.basis, .count = array.count, .spacing = array.pitch};
  }
  const double depth = least_depth(array);
  const double wanted =
      options.spacing.value_or(is_dense(array) ? std::min(array.pitch, 0.5 * depth) : 0.25 * depth);
  // Whole steps from taxel to taxel of a regular array, from the first to the last of an irregular
  // one.
  const double first = position(array, 0);
  const double length = is_even(array) ? array.pitch : position(array, array.count - 1) - first;
  const double parts = is_even(array) ? static_cast<double>(array.count - 1) : 1.0;
  const auto [spacing, stride] = steps_over(length, wanted);
  const double reach = rounded_up(options.margin.value_or(2.0 * depth) / spacing);
  // The outermost hats end one spacing further.
  const double margin = std::max(reach - 1.0, length > 0.0 ? 0.0 : 1.0);
  const double count = parts * stride + 2.0 * margin + 1.0;
  if (!(count <= static_cast<double>(most_values)))
    throw std::invalid_argument("the surface would have more than " + std::to_string(most_values) +
                                " values: choose a larger spacing or a smaller margin");
  return {.basis = options.basis,
          .count = static_cast<std::size_t>(count),
          .spacing = spacing,
          .centre = is_even(array) ? 0.0 : first + 0.5 * length,
          .margin = static_cast<std::size_t>(margin),
          .stride = is_even(array) ? static_cast<std::size_t>(stride) : 0};
}

}  // namespace tactile_net
