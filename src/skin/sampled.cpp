#include <cstddef>

#include "skin/cell_kernel.hpp"
#include "tactile_net/skin/forward.hpp"

namespace tactile_net {
namespace {

/// Taxels on the lattice of the cells: a kernel for each distance that occurs.
void add_lattice(const SkinArray& skin, CellKernels& kernels, const SkinGrid& grid,
                 std::size_t components, std::span<const double> tractions,
                 std::span<double> readings) {
  for (const SkinChannel& channel : channels(skin))
    for (std::size_t k = 0; k < components; ++k) {
      const LatticeKernel kernel(kernels(channel.depth), channel.quantity, skin_tractions[k], grid);
      const auto own = tractions.subspan(k * grid.count(), grid.count());
      for (std::size_t i = 0; i < channel.count; ++i) {
        const auto [at_row, at_column] = cell_of(skin, grid, i);
        double sum = 0.0;
        for (std::size_t row = 0; row < grid.rows; ++row)
          for (std::size_t column = 0; column < grid.columns; ++column)
            sum += kernel(at_row, at_column, row, column) * own[row * grid.columns + column];
        readings[channel.first + i] += sum;
      }
    }
}

/// Taxels anywhere.
void add_places(const SkinArray& skin, CellKernels& kernels, const SkinGrid& grid,
                std::size_t components, std::span<const double> tractions,
                std::span<double> readings) {
  const std::size_t count = grid.count();
  std::vector<double> y(count);
  std::vector<double> z(count);
  std::vector<double> row(count);
  for (std::size_t reading = 0; const SkinSite& site : sites(skin)) {
    for (std::size_t i = 0; i < count; ++i) {
      y[i] = site.y - grid.y(i / grid.columns);
      z[i] = site.z - grid.z(i % grid.columns);
    }
    for (std::size_t k = 0; k < components; ++k) {
      kernels(site.depth)(site.quantity, skin_tractions[k], y, z, row);
      for (std::size_t i = 0; i < count; ++i)
        readings[reading] += row[i] * tractions[k * count + i];
    }
    ++reading;
  }
}

}  // namespace

std::vector<double> sampled_readings(const SkinArray& skin, const Material& material,
                                     const SkinGrid& grid, std::span<const double> tractions) {
  const std::size_t components = check_sampled(skin, material, grid, tractions);
  CellKernels kernels(material, grid);
  std::vector<double> readings(reading_count(skin));
  const auto add = is_lattice(skin, grid) ? add_lattice : add_places;
  add(skin, kernels, grid, components, tractions, readings);
  return readings;
}

}  // namespace tactile_net
