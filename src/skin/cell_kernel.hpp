/// @file
/// What a cell of the surface causes. Private.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/grid.hpp"

namespace tactile_net {

/// What the cells of a grid cause at places of one depth, by the grid's rule.
class CellKernel {
 public:
  /// @throw std::invalid_argument  as `SkinKernel`
  CellKernel(const Material& material, double depth, const SurfaceGrid& grid);

  /// [reading per Pa] of the cell's traction, at each (y, z) from its middle.
  void operator()(Quantity quantity, Traction component, std::span<const double> y,
                  std::span<const double> z, std::span<double> readings) const noexcept;

  /// The largest error of an entry.
  [[nodiscard]] double error_bound(Quantity quantity) const noexcept;

 private:
  SkinKernel kernel_;
  SurfaceGrid grid_;
  double depth_;
};

/// The kernels of a skin, made once for each depth.
class CellKernels {
 public:
  CellKernels(const Material& material, const SurfaceGrid& grid)
      : material_(material), grid_(grid) {}

  const CellKernel& operator()(double depth) {
    return made_.try_emplace(depth, material_, depth, grid_).first->second;
  }

 private:
  Material material_;
  SurfaceGrid grid_;
  std::map<double, CellKernel> made_{};
};

/// Readings at all distances between cells' middles: what cells do to taxels on their lattice.
class LatticeKernel {
 public:
  LatticeKernel(const CellKernel& kernel, Quantity quantity, Traction component,
                const SurfaceGrid& grid);

  /// Of the cell (row, column) at the middle of the cell (at_row, at_column).
  [[nodiscard]] double operator()(std::size_t at_row, std::size_t at_column, std::size_t row,
                                  std::size_t column) const noexcept {
    const bool before_y = at_row < row;
    const bool before_z = at_column < column;
    const double value = quadrant_[(before_y ? row - at_row : at_row - row) * columns_ +
                                   (before_z ? column - at_column : at_column - column)];
    return (before_y && odd_y_) != (before_z && odd_z_) ? -value : value;
  }

 private:
  std::size_t columns_;
  bool odd_y_, odd_z_;
  std::vector<double> quadrant_;
};

/// Where a taxel of a regular skin lies on the grid.
struct LatticeCell {
  std::size_t row;
  std::size_t column;
};
[[nodiscard]] inline LatticeCell cell_of(const SkinArray& skin, const SurfaceGrid& grid,
                                         std::size_t taxel) noexcept {
  return {grid.margin_rows + taxel / skin.columns * grid.stride_rows,
          grid.margin_columns + taxel % skin.columns * grid.stride_columns};
}

/// Whether every taxel lies on a cell's middle, by the grid's strides.
[[nodiscard]] bool is_lattice(const SkinArray& skin, const SurfaceGrid& grid) noexcept;

/// @throw std::invalid_argument  the skin or the material is out of range, there is not one
///                               component or three, or a reading has no value under them
void check_sampled(const SkinArray& skin, const Material& material, std::size_t components);

/// @throw std::invalid_argument  not one value for each cell and component
void check_tractions(const SurfaceGrid& grid, std::size_t components,
                     std::span<const double> tractions);

}  // namespace tactile_net
