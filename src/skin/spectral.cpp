#include "tactile_net/skin/spectral.hpp"

#include <stdexcept>

#include "skin/cell_kernel.hpp"
#include "skin/large/lattice_products.hpp"

namespace tactile_net {

struct SpectralSkinModel::Plan {
  Plan(const SkinArray& skin, const Material& material, const SurfaceGrid& cells, std::size_t count)
      : grid(cells),
        components(count),
        values(reading_count(skin)),
        products(skin, grid, count, lattice_kernels(skin, material, grid, count)) {}

  SurfaceGrid grid;
  std::size_t components;
  std::size_t values;  // of a frame
  LatticeProducts products;
};

SpectralSkinModel::SpectralSkinModel(const SkinArray& skin, const Material& material,
                                     const SurfaceGrid& grid, std::size_t components) {
  check_sampled(skin, material, components);
  if (!is_lattice(skin, grid))
    throw std::invalid_argument(
        "the taxels must lie on the lattice of the grid's cells for an FFT: use sampled_readings");
  plan_ = std::make_unique<Plan>(skin, material, grid, components);
}

SpectralSkinModel::~SpectralSkinModel() = default;
SpectralSkinModel::SpectralSkinModel(SpectralSkinModel&&) noexcept = default;
SpectralSkinModel& SpectralSkinModel::operator=(SpectralSkinModel&&) noexcept = default;

std::vector<double> SpectralSkinModel::readings(std::span<const double> tractions) {
  check_tractions(plan_->grid, plan_->components, tractions);
  std::vector<double> all(plan_->values);
  plan_->products.readings(tractions, all);
  return all;
}

}  // namespace tactile_net
