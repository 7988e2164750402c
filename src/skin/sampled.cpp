#include <cstddef>
#include <string>

#include "numeric/require.hpp"
#include "skin/cell_kernel.hpp"
#include "skin/curved_kernel.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

struct SampledSkinModel::Kernels {
  SkinArray skin;
  SurfaceGrid grid;
  std::size_t components;
  std::vector<LatticeKernel> lattice{};  // of each channel and component; empty: taxels anywhere
  Matrix places{};                       // readings x (components x cells) of these
};

namespace {

/// Of taxels anywhere, all distances.
Matrix kernels_of_places(const SkinArray& skin, CellKernels& kernels, const SurfaceGrid& grid,
                         std::size_t components) {
  const std::size_t count = grid.count();
  Matrix all{.rows = reading_count(skin), .columns = components * count};
  require(all.columns <= most_kernel_entries / all.rows, "readings times cells",
          "be at most " + std::to_string(most_kernel_entries), all.columns * all.rows);
  all.values.resize(all.rows * all.columns);
  std::vector<double> y(count);
  std::vector<double> z(count);
  for (std::size_t reading = 0; const Site& site : sites(skin)) {
    for (std::size_t i = 0; i < count; ++i) {
      y[i] = site.y - grid.y(i / grid.columns);
      z[i] = site.z - grid.z(i % grid.columns);
    }
    for (std::size_t k = 0; k < components; ++k)
      kernels(site.depth)(site.quantity, skin_tractions[k], y, z,
                          std::span(all.values).subspan(reading * all.columns + k * count, count));
    ++reading;
  }
  return all;
}

}  // namespace

SampledSkinModel::SampledSkinModel(const SkinArray& skin, const Material& material,
                                   const SurfaceGrid& grid, std::size_t components) {
  check_sampled(skin, material, components);
  Kernels made{.skin = skin, .grid = grid, .components = components};
  if (skin.curved) {
    made.places = CurvedReadings(skin, material).kernel(grid, components);
    kernels_ = std::make_shared<const Kernels>(std::move(made));
    return;
  }
  CellKernels kernels(material, grid);
  if (is_lattice(skin, grid)) {
    for (const Channel& channel : channels(skin))
      for (std::size_t k = 0; k < components; ++k)
        made.lattice.emplace_back(kernels(channel.depth), channel.quantity, skin_tractions[k],
                                  grid);
  } else {
    made.places = kernels_of_places(skin, kernels, grid, components);
  }
  kernels_ = std::make_shared<const Kernels>(std::move(made));
}

std::vector<double> SampledSkinModel::readings(std::span<const double> tractions) const {
  const auto& [skin, grid, components, lattice, places] = *kernels_;
  check_tractions(grid, components, tractions);
  std::vector<double> readings(reading_count(skin));
  if (lattice.empty()) {
    for (std::size_t i = 0; i < readings.size(); ++i)
      for (std::size_t j = 0; j < places.columns; ++j) readings[i] += places(i, j) * tractions[j];
    return readings;
  }
  for (std::size_t c = 0; const Channel& channel : channels(skin)) {
    for (std::size_t k = 0; k < components; ++k) {
      const LatticeKernel& kernel = lattice[c * components + k];
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
    ++c;
  }
  return readings;
}

std::vector<double> sampled_readings(const SkinArray& skin, const Material& material,
                                     const SurfaceGrid& grid, std::span<const double> tractions) {
  const std::size_t count = grid.count();
  require(tractions.size() == count || tractions.size() == 3 * count, "tractions",
          "hold one value for each cell and component, " + std::to_string(count) + " or " +
              std::to_string(3 * count),
          tractions.size());
  return SampledSkinModel(skin, material, grid, tractions.size() / count).readings(tractions);
}

}  // namespace tactile_net
