/// @file
/// Transforms, real and complex, with their buffers, by the FFT that the build chose
/// (TACTILE_NET_FFT): a source file each, `real_fft_fftw.cpp` and `real_fft_eigen.cpp`, which say
/// what `Fft::Transform` and `Fft::error` are. Private.
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

#include "tactile_net/numeric/fft.hpp"

namespace tactile_net {

/// `count` zeros, where a vector register can be loaded from.
template <class Number>
class FftBuffer {
 public:
  explicit FftBuffer(std::size_t count)
      : count_(count),
        memory_(static_cast<Number*>(::operator new(count * sizeof(Number), alignment))) {
    std::uninitialized_value_construct_n(memory_.get(), count);
  }
  [[nodiscard]] std::span<Number> values() const noexcept { return {memory_.get(), count_}; }

 private:
  static constexpr std::align_val_t alignment{64};
  struct Free {
    void operator()(Number* memory) const noexcept { ::operator delete(memory, alignment); }
  };
  std::size_t count_;
  std::unique_ptr<Number[], Free> memory_;
};

/// A pair of transforms of one size between samples, which are real or complex, and their bins:
///
///     bin_k = sum_j sample_j exp(-2 pi i j k / size)
///
/// size() bins, or size() / 2 + 1 of real samples. Equal sizes get equal bits, but for
/// FftEffort::measure. Copies have buffers of their own, zeroed; they may be made and used in
/// another thread. For the sizes of `fast_size` a transform allocates nothing.
template <class Sample>
class Fft {
 public:
  /// @param size  from 1
  /// @throw std::bad_alloc
  explicit Fft(std::size_t size, FftEffort effort = FftEffort::estimate);
  Fft(const Fft& other);
  Fft(Fft&&) noexcept;
  Fft& operator=(Fft&&) noexcept;
  Fft& operator=(const Fft&) = delete;
  ~Fft();

  [[nodiscard]] std::size_t size() const noexcept { return samples_.values().size(); }
  [[nodiscard]] std::span<Sample> samples() noexcept { return samples_.values(); }
  [[nodiscard]] std::span<std::complex<double>> bins() noexcept { return bins_.values(); }

  /// samples -> bins; the samples are kept.
  void forward() noexcept;
  /// bins -> size() times samples; the bins of real samples are destroyed, others kept.
  void backward() noexcept;

  /// The least even size >= `size` without a prime factor above 7: such transforms are fast.
  [[nodiscard]] static std::size_t fast_size(std::size_t size) noexcept {
    for (size += size % 2;; size += 2) {
      std::size_t rest = size;
      for (const std::size_t prime : {2U, 3U, 5U, 7U})
        while (rest % prime == 0) rest /= prime;
      if (rest == 1) return size;
    }
  }

  /// The relative error of one transform in the 2-norm.
  [[nodiscard]] static double error(std::size_t size) noexcept;

 private:
  struct Transform;  // the FFT's own

  static constexpr bool is_real = std::is_same_v<Sample, double>;

  FftBuffer<Sample> samples_;
  FftBuffer<std::complex<double>> bins_;
  std::unique_ptr<Transform> transform_;
};

using RealFft = Fft<double>;
using ComplexFft = Fft<std::complex<double>>;

// Where an FFT's own library is known.
extern template class Fft<double>;
extern template class Fft<std::complex<double>>;

/// a b, written out: operator* of std::complex tests for NaN, and this is the inner loop.
[[nodiscard]] inline std::complex<double> product(std::complex<double> a,
                                                  std::complex<double> b) noexcept {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// conj(a) b.
[[nodiscard]] inline std::complex<double> conjugate_product(std::complex<double> a,
                                                            std::complex<double> b) noexcept {
  return {a.real() * b.real() + a.imag() * b.imag(), a.real() * b.imag() - a.imag() * b.real()};
}

/// Puts a kernel of 2 count - 1 values (`sampled_kernel`) around a circle of `size` >= that many
/// points, lag m at place m modulo size, and transforms it.
inline void transform_kernel(RealFft& fft, std::span<const double> kernel) {
  const std::size_t count = kernel.size() / 2 + 1;
  const auto samples = fft.samples();
  const auto zero_lag = kernel.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::fill(samples.begin(), samples.end(), 0.0);
  std::copy(zero_lag, kernel.end(), samples.begin());
  std::copy(kernel.begin(), zero_lag, samples.end() - static_cast<std::ptrdiff_t>(count - 1));
  fft.forward();
}

}  // namespace tactile_net
