/// @file
/// One block of the discrete sum by FFT (tactile_net/sensing/spectral.hpp). Private.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace tactile_net {

/// One Toeplitz block applied by FFT: the linear convolution, zero-padded so that nothing wraps.
///
/// The constructor plans and transforms the kernel (where the FFT is FFTW, its planner is not
/// thread-safe: this library locks it against itself, not against others). `add` reuses buffers:
/// one object per thread.
class SpectralConvolution {
 public:
  /// @param kernel  2 count - 1 values as from `sampled_kernel`
  /// @throw std::invalid_argument  the kernel's size is an even number, less than 3 or more than
  ///                               2^30
  explicit SpectralConvolution(std::span<const double> kernel);
  ~SpectralConvolution();
  SpectralConvolution(SpectralConvolution&&) noexcept;
  SpectralConvolution& operator=(SpectralConvolution&&) noexcept;

  /// out(n) += sum_i kernel(n - i) in(i), equal to `add_convolution` within 1e-13 of
  /// max|kernel| * sum|in|. O(count log count). Both spans hold `count` values.
  void add(std::span<const double> in, std::span<double> out);

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

/// Taxels from which the FFT is the faster way for one block that is used once, its plan included;
/// below it the sum is. Measured on one core of a x86-64 server, GCC 12 -O3 with SSE2, FFTW
/// 3.3.10: 60 us for either at 512, 60 against 81 us at 600. A plan that is kept wins from 128 on.
inline constexpr std::size_t spectral_crossover = 512;

}  // namespace tactile_net
