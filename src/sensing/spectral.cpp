#include "tactile_net/sensing/spectral.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "sensing/real_fft.hpp"
#include "sensing/superpose.hpp"

namespace tactile_net {

struct SpectralConvolution::Plan {
  explicit Plan(std::span<const double> kernel)
      : count(kernel.size() / 2 + 1), fft(RealFft::fast_size(kernel.size())) {
    transform_kernel(fft, kernel);
    response.assign(fft.bins().begin(), fft.bins().end());
    for (std::complex<double>& bin : response) bin /= static_cast<double>(fft.size());
  }

  void add(std::span<const double> in, std::span<double> out) {
    assert(in.size() == count && out.size() == count);
    std::fill(std::copy(in.begin(), in.end(), fft.samples().begin()), fft.samples().end(), 0.0);
    fft.forward();
    for (std::size_t i = 0; i < response.size(); ++i)
      fft.bins()[i] = product(fft.bins()[i], response[i]);
    fft.backward();
    for (std::size_t n = 0; n < count; ++n) out[n] += fft.samples()[n];
  }

  std::size_t count;
  RealFft fft;  // >= 2 count - 1 points: what wraps around falls on places that nobody reads
  std::vector<std::complex<double>> response;  // the kernel's spectrum / size
};

SpectralConvolution::SpectralConvolution(std::span<const double> kernel) {
  if (kernel.size() < 3 || kernel.size() % 2 == 0)
    throw std::invalid_argument("kernel must hold 2 count - 1 >= 3 values (got " +
                                std::to_string(kernel.size()) + ")");
  if (kernel.size() > std::numeric_limits<int>::max() / 2)
    throw std::invalid_argument("kernel must hold at most 2^30 values");
  plan_ = std::make_unique<Plan>(kernel);
}

SpectralConvolution::~SpectralConvolution() = default;
SpectralConvolution::SpectralConvolution(SpectralConvolution&&) noexcept = default;
SpectralConvolution& SpectralConvolution::operator=(SpectralConvolution&&) noexcept = default;

void SpectralConvolution::add(std::span<const double> in, std::span<double> out) {
  plan_->add(in, out);
}

std::vector<double> fast_sampled_readings(const SensorArray& array, const Material& material,
                                          const TractionField& field) {
  if (array.count < spectral_crossover) return sampled_readings(array, material, field);
  return superpose(array, material, field,
                   [](std::span<const double> kernel, std::span<const double> in,
                      std::span<double> out) { SpectralConvolution(kernel).add(in, out); });
}

}  // namespace tactile_net
