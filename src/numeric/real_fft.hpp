/// @file
/// Transforms, real and complex, with their buffers, by the FFT that the build chose
/// (TACTILE_NET_FFT): a source file each, `real_fft_fftw.cpp` and `real_fft_eigen.cpp`. Private.
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <memory>
#include <span>

#include "tactile_net/numeric/fft.hpp"

namespace tactile_net {

/// A pair of real transforms of one size. Equal sizes get equal bits, but for FftEffort::measure.
/// Copies have buffers of their own, zeroed; they may be made and used in another thread. For the
/// sizes of `fast_size` a transform allocates nothing.
class RealFft {
 public:
  explicit RealFft(std::size_t size, FftEffort effort = FftEffort::estimate);
  RealFft(const RealFft& other);
  RealFft(RealFft&&) noexcept;
  RealFft& operator=(RealFft&&) noexcept;
  RealFft& operator=(const RealFft&) = delete;
  ~RealFft();

  [[nodiscard]] std::size_t size() const noexcept { return samples_.size(); }
  [[nodiscard]] std::span<double> samples() noexcept { return samples_; }
  /// size() / 2 + 1 of them.
  [[nodiscard]] std::span<std::complex<double>> bins() noexcept { return bins_; }

  /// samples -> bins; the samples are kept.
  void forward() noexcept;
  /// bins -> size() times samples; the bins are destroyed.
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
  struct Transform;  // the FFT's own, and the memory of the spans
  explicit RealFft(std::unique_ptr<Transform> transform);

  std::unique_ptr<Transform> transform_;
  std::span<double> samples_;
  std::span<std::complex<double>> bins_;
};

/// A pair of complex transforms of one size. Copies as those of `RealFft`.
class ComplexFft {
 public:
  explicit ComplexFft(std::size_t size);
  ComplexFft(const ComplexFft& other);
  ComplexFft(ComplexFft&&) noexcept;
  ComplexFft& operator=(ComplexFft&&) noexcept;
  ComplexFft& operator=(const ComplexFft&) = delete;
  ~ComplexFft();

  [[nodiscard]] std::span<std::complex<double>> samples() noexcept { return samples_; }
  [[nodiscard]] std::span<std::complex<double>> bins() noexcept { return bins_; }

  /// samples -> bins; the samples are kept.
  void forward() noexcept;
  /// bins -> size times samples; the bins are kept.
  void backward() noexcept;

 private:
  struct Transform;
  explicit ComplexFft(std::unique_ptr<Transform> transform);

  std::unique_ptr<Transform> transform_;
  std::span<std::complex<double>> samples_, bins_;
};

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
