#include "skin/cell_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "numeric/require.hpp"

namespace tactile_net {

CellKernel::CellKernel(const Material& material, double depth, const SurfaceGrid& grid)
    : kernel_(material, depth), grid_(grid), depth_(depth) {}

void CellKernel::operator()(Quantity quantity, Traction component, std::span<const double> y,
                            std::span<const double> z, std::span<double> readings) const noexcept {
  if (grid_.rectangles) {
    kernel_(quantity, component, Rectangle{grid_.spacing_y, grid_.spacing_z}, y, z, readings);
    return;
  }
  kernel_(quantity, component, y, z, readings);
  // One length after the other: an area may be too large, or too small, for a number.
  for (double& reading : readings) reading = reading * grid_.spacing_y * grid_.spacing_z;
}

double CellKernel::error_bound(Quantity quantity) const noexcept {
  const double area = grid_.rectangles ? std::min(grid_.area(), depth_ * depth_) : grid_.area();
  return kernel_.error_bound(quantity) * area;
}

LatticeKernel::LatticeKernel(const CellKernel& kernel, Quantity quantity, Traction component,
                             const SurfaceGrid& grid)
    : columns_(grid.columns),
      odd_y_(is_odd(quantity, component, Axis::y)),
      odd_z_(is_odd(quantity, component, Axis::z)),
      quadrant_(grid.count()) {
  std::vector<double> y(grid.count());
  std::vector<double> z(grid.count());
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const std::size_t row = i / grid.columns;
    y[i] = static_cast<double>(row) * grid.spacing_y;
    z[i] = static_cast<double>(i % grid.columns) * grid.spacing_z;
  }
  kernel(quantity, component, y, z, quadrant_);
}

bool is_lattice(const SkinArray& skin, const SurfaceGrid& grid) noexcept {
  if (!is_even(skin) || grid.stride_rows == 0 || grid.stride_columns == 0) return false;
  const auto [row, column] = cell_of(skin, grid, taxel_count(skin) - 1);
  if (row + grid.margin_rows + 1 != grid.rows || column + grid.margin_columns + 1 != grid.columns)
    return false;
  const auto fits = [](std::size_t taxels, double pitch, std::size_t stride, double spacing) {
    return taxels == 1 || std::abs(pitch - static_cast<double>(stride) * spacing) <= 1e-12 * pitch;
  };
  return grid.centre_y == 0.0 && grid.centre_z == 0.0 &&
         fits(skin.rows, skin.pitch_y, grid.stride_rows, grid.spacing_y) &&
         fits(skin.columns, skin.pitch_z, grid.stride_columns, grid.spacing_z);
}

void check_sampled(const SkinArray& skin, const Material& material, std::size_t components) {
  require(components == 1 || components == 3, "components", "be 1 or 3", components);
  check(skin, material);
  for (std::size_t k = 0; k < components; ++k)
    for (const Quantity quantity : skin.reads)
      check_quantity(quantity, skin_tractions[k], material);
}

void check_tractions(const SurfaceGrid& grid, std::size_t components,
                     std::span<const double> tractions) {
  const std::size_t count = components * grid.count();
  require(tractions.size() == count, "tractions",
          "hold one value for each cell and component, " + std::to_string(count), tractions.size());
}

}  // namespace tactile_net
