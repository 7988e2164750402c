/// @file
/// FFTW's real transforms with their buffers and plans. Private.
#pragma once

#include <fftw3.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <type_traits>

namespace tactile_net {

/// FFTW's planner is not thread-safe, its execution is: held while plans are made and destroyed.
inline std::recursive_mutex fftw_planner;

/// A pair of real transforms of one size. FFTW_ESTIMATE never times anything: equal sizes get equal
/// plans, and equal bits. Copies share the plans and have buffers of their own, zeroed.
class RealFft {
 public:
  explicit RealFft(std::size_t size, unsigned rigour = FFTW_ESTIMATE) : RealFft(size, nullptr) {
    const std::lock_guard lock(fftw_planner);
    const int n = static_cast<int>(size);
    forward_.reset(fftw_plan_dft_r2c_1d(n, samples_.get(), complex_bins(), rigour), Destroy{});
    backward_.reset(fftw_plan_dft_c2r_1d(n, complex_bins(), samples_.get(), rigour), Destroy{});
    if (!forward_ || !backward_) throw std::bad_alloc();
    // A planner that measures writes there.
    std::fill(samples().begin(), samples().end(), 0.0);
    std::fill(bins().begin(), bins().end(), 0.0);
  }
  RealFft(const RealFft& other) : RealFft(other.size_, nullptr) {
    forward_ = other.forward_;
    backward_ = other.backward_;
  }
  RealFft(RealFft&&) noexcept = default;
  RealFft& operator=(RealFft&&) noexcept = default;
  RealFft& operator=(const RealFft&) = delete;
  ~RealFft() = default;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::span<double> samples() noexcept { return {samples_.get(), size_}; }
  [[nodiscard]] std::span<std::complex<double>> bins() noexcept {
    return {bins_.get(), size_ / 2 + 1};
  }

  /// samples -> bins; the samples are kept.
  void forward() noexcept { fftw_execute_dft_r2c(forward_.get(), samples_.get(), complex_bins()); }
  /// bins -> size() times samples; the bins are destroyed.
  void backward() noexcept {
    fftw_execute_dft_c2r(backward_.get(), complex_bins(), samples_.get());
  }

  /// The least even size >= `size` without a prime factor above 7, for which FFTW is fast.
  [[nodiscard]] static std::size_t fast_size(std::size_t size) noexcept {
    for (size += size % 2;; size += 2) {
      std::size_t rest = size;
      for (const std::size_t prime : {2U, 3U, 5U, 7U})
        while (rest % prime == 0) rest /= prime;
      if (rest == 1) return size;
    }
  }

 private:
  struct Free {
    void operator()(void* memory) const noexcept { fftw_free(memory); }
  };
  struct Destroy {
    void operator()(fftw_plan plan) const noexcept {
      const std::lock_guard lock(fftw_planner);
      fftw_destroy_plan(plan);
    }
  };
  using Transform = std::shared_ptr<std::remove_pointer_t<fftw_plan>>;

  RealFft(std::size_t size, std::nullptr_t)
      : size_(size),
        samples_(allocate<double>(size)),
        bins_(allocate<std::complex<double>>(size / 2 + 1)) {}

  [[nodiscard]] fftw_complex* complex_bins() const noexcept {
    return reinterpret_cast<fftw_complex*>(bins_.get());
  }

  template <class Number>
  static std::unique_ptr<Number[], Free> allocate(std::size_t count) {
    void* memory = fftw_malloc(count * sizeof(Number));
    if (memory == nullptr) throw std::bad_alloc();
    const auto first = static_cast<Number*>(memory);
    std::uninitialized_value_construct_n(first, count);
    return std::unique_ptr<Number[], Free>(first);
  }

  std::size_t size_;
  std::unique_ptr<double[], Free> samples_;
  std::unique_ptr<std::complex<double>[], Free> bins_;
  Transform forward_, backward_;
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
