#include "tactile_net/sensing/spectral.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cassert>
#include <complex>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "sensing/superpose.hpp"

namespace tactile_net {

namespace {

struct Free {
  void operator()(void* memory) const noexcept { fftw_free(memory); }
};
template <class Number>
using Buffer = std::unique_ptr<Number[], Free>;

template <class Number>
Buffer<Number> buffer(std::size_t size) {
  void* memory = fftw_malloc(size * sizeof(Number));
  if (memory == nullptr) throw std::bad_alloc();
  const auto first = static_cast<Number*>(memory);
  std::uninitialized_value_construct_n(first, size);
  return Buffer<Number>(first);
}

struct Destroy {
  void operator()(fftw_plan plan) const noexcept { fftw_destroy_plan(plan); }
};
using Transform = std::unique_ptr<std::remove_pointer_t<fftw_plan>, Destroy>;

/// The least even size >= `size` without a prime factor above 7, for which FFTW is fast.
std::size_t fast_size(std::size_t size) {
  for (size += size % 2;; size += 2) {
    std::size_t rest = size;
    for (const std::size_t prime : {2U, 3U, 5U, 7U})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return size;
  }
}

}  // namespace

struct SpectralConvolution::Plan {
  explicit Plan(std::span<const double> kernel);
  void add(std::span<const double> in, std::span<double> out);

  std::size_t count;
  std::size_t size;  // >= 2 count - 1: what wraps around falls on places that nobody reads
  Buffer<double> samples = buffer<double>(size);
  Buffer<std::complex<double>> spectrum = buffer<std::complex<double>>(size / 2 + 1);
  std::vector<std::complex<double>> response;  // the kernel's spectrum / size
  Transform forward;
  Transform backward;
};

SpectralConvolution::Plan::Plan(std::span<const double> kernel)
    : count(kernel.size() / 2 + 1), size(fast_size(kernel.size())) {
  // FFTW_ESTIMATE never times anything: equal sizes get equal plans, and equal bits.
  auto* const bins = reinterpret_cast<fftw_complex*>(spectrum.get());
  const int n = static_cast<int>(size);
  forward.reset(fftw_plan_dft_r2c_1d(n, samples.get(), bins, FFTW_ESTIMATE));
  backward.reset(fftw_plan_dft_c2r_1d(n, bins, samples.get(), FFTW_ESTIMATE));
  if (!forward || !backward) throw std::bad_alloc();

  // Entry m of the kernel goes to place m modulo size.
  const auto zero_lag = kernel.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::copy(zero_lag, kernel.end(), samples.get());
  std::copy(kernel.begin(), zero_lag, samples.get() + (size - (count - 1)));
  fftw_execute(forward.get());
  response.assign(spectrum.get(), spectrum.get() + size / 2 + 1);
  for (std::complex<double>& bin : response) bin /= static_cast<double>(size);
}

void SpectralConvolution::Plan::add(std::span<const double> in, std::span<double> out) {
  assert(in.size() == count && out.size() == count);
  std::fill(std::copy(in.begin(), in.end(), samples.get()), samples.get() + size, 0.0);
  fftw_execute(forward.get());
  for (std::size_t i = 0; i < response.size(); ++i) {
    // Written out: operator* of std::complex tests for NaN, and this is the inner loop.
    const std::complex<double> a = spectrum[i];
    const std::complex<double> b = response[i];
    spectrum[i] = {a.real() * b.real() - a.imag() * b.imag(),
                   a.real() * b.imag() + a.imag() * b.real()};
  }
  fftw_execute(backward.get());
  for (std::size_t n = 0; n < count; ++n) out[n] += samples[n];
}

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
