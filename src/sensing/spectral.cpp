#include "tactile_net/sensing/spectral.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "numeric/real_fft.hpp"
#include "sensing/spectral_convolution.hpp"
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

/// One block, by the faster way.
struct SampledModel::Block {
  explicit Block(std::vector<double> values) : kernel(std::move(values)) {
    if (kernel.size() / 2 + 1 >= spectral_crossover) fft.emplace(kernel);
  }
  void add(std::span<const double> in, std::span<double> out) {
    if (fft)
      fft->add(in, out);
    else
      add_convolution(kernel, in, out);
  }
  std::vector<double> kernel;
  std::optional<SpectralConvolution> fft;
};

SampledModel::SampledModel(const SensorArray& array, const Material& material)
    : array_(array), material_(material), channels_(channels(array)) {
  check(array);
  check(material);
  blocks_.resize(2 * channels_.size());
}

SampledModel::~SampledModel() = default;
SampledModel::SampledModel(SampledModel&&) noexcept = default;
SampledModel& SampledModel::operator=(SampledModel&&) noexcept = default;

std::vector<double> SampledModel::readings(const TractionField& field) {
  const auto add_block = [&](std::size_t channel, Traction component, std::span<const double> in,
                             std::span<double> out) {
    auto& block = blocks_[2 * channel + static_cast<std::size_t>(component)];
    if (!block)
      block = std::make_unique<Block>(
          sampled_kernel(channels_[channel], component, material_, array_.count, array_.pitch));
    block->add(in, out);
  };
  return superpose(array_, field, add_block);
}

std::vector<double> fast_sampled_readings(const SensorArray& array, const Material& material,
                                          const TractionField& field) {
  return SampledModel(array, material).readings(field);
}

}  // namespace tactile_net
