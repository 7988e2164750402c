#include "tactile_net/skin/spectral.hpp"

#include <algorithm>
#include <complex>
#include <stdexcept>
#include <string>

#include "numeric/real_fft.hpp"
#include "skin/cell_kernel.hpp"

namespace tactile_net {

struct SpectralSkinModel::Plan {
  using Spectrum = std::vector<std::complex<double>>;

  Plan(const SkinArray& array, const Material& material, const SkinGrid& cells, std::size_t count)
      : skin(array),
        grid(cells),
        components(count),
        width(2 * cells.columns - 1),
        fft(RealFft::fast_size(2 * cells.rows * width - 1)),
        tractions(components, Spectrum(fft.bins().size())) {
    CellKernels kernels(material, grid);
    for (const SkinChannel& channel : channels(skin))
      for (std::size_t k = 0; k < components; ++k)
        transform(LatticeKernel(kernels(channel.depth), channel.quantity, skin_tractions[k], grid));
  }

  /// The readings at all lags (m, n) of cells, as one line of 2 rows * width - 1 values.
  void transform(const LatticeKernel& kernel) {
    const std::size_t middle = grid.rows * width - 1;
    std::vector<double> line(2 * middle + 1);
    for (std::size_t m = 0; m < 2 * grid.rows - 1; ++m)
      for (std::size_t n = 0; n < width; ++n) {
        // From the cell (0, 0) to the cell (m, n) minus (rows - 1, columns - 1).
        const std::size_t row = grid.rows - 1;
        const std::size_t column = grid.columns - 1;
        const auto ahead = [](std::size_t lag, std::size_t zero) {
          return lag > zero ? lag - zero : 0;
        };
        const auto behind = [](std::size_t lag, std::size_t zero) {
          return lag < zero ? zero - lag : 0;
        };
        line[middle + m * width + n - row * width - column] =
            kernel(ahead(m, row), ahead(n, column), behind(m, row), behind(n, column));
      }
    transform_kernel(fft, line);
    responses.emplace_back(fft.bins().begin(), fft.bins().end());
    for (std::complex<double>& bin : responses.back()) bin /= static_cast<double>(fft.size());
  }

  std::vector<double> readings(std::span<const double> values) {
    for (std::size_t k = 0; k < components; ++k) {
      const auto samples = fft.samples();
      std::fill(samples.begin(), samples.end(), 0.0);
      for (std::size_t row = 0; row < grid.rows; ++row)
        for (std::size_t column = 0; column < grid.columns; ++column)
          samples[row * width + column] = values[k * grid.count() + row * grid.columns + column];
      fft.forward();
      std::copy(fft.bins().begin(), fft.bins().end(), tractions[k].begin());
    }
    std::vector<double> all(reading_count(skin));
    for (std::size_t response = 0; const SkinChannel& channel : channels(skin)) {
      std::fill(fft.bins().begin(), fft.bins().end(), 0.0);
      for (std::size_t k = 0; k < components; ++k, ++response)
        for (std::size_t i = 0; i < tractions[k].size(); ++i)
          fft.bins()[i] += product(tractions[k][i], responses[response][i]);
      fft.backward();
      for (std::size_t i = 0; i < channel.count; ++i) {
        const auto [row, column] = cell_of(skin, grid, i);
        all[channel.first + i] = fft.samples()[row * width + column];
      }
    }
    return all;
  }

  SkinArray skin;
  SkinGrid grid;
  std::size_t components;
  std::size_t width;  // of a row with its empty places
  RealFft fft;
  std::vector<Spectrum> tractions;  // of each component
  std::vector<Spectrum> responses;  // of each channel and component: the kernel's spectrum / size
};

SpectralSkinModel::SpectralSkinModel(const SkinArray& skin, const Material& material,
                                     const SkinGrid& grid, std::size_t components) {
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
  return plan_->readings(tractions);
}

}  // namespace tactile_net
