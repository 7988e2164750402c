/// @file
/// The discrete sum by FFT (target tactile_net::spectral).
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/sensing/sampled.hpp"

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

/// The discrete sum for one field after another: kernels are computed, and transformed where the
/// FFT is faster, when a field first needs them. One object per thread; the first use plans.
class SampledModel {
 public:
  /// @throw std::invalid_argument  the array or the material is out of range
  SampledModel(const SensorArray& array, const Material& material);
  ~SampledModel();
  SampledModel(SampledModel&&) noexcept;
  SampledModel& operator=(SampledModel&&) noexcept;

  /// The readings of `sampled_readings`; each block is equal within the bound of
  /// `SpectralConvolution::add`.
  ///
  /// @throw std::invalid_argument  the field's sizes do not fit the array
  [[nodiscard]] std::vector<double> readings(const TractionField& field);

 private:
  struct Block;
  SensorArray array_;
  Material material_;
  std::vector<Channel> channels_;
  std::vector<std::unique_ptr<Block>> blocks_;  // per channel: normal, tangential
};

/// The readings of `sampled_readings`, by whichever way is faster; each block is equal within the
/// bound of `SpectralConvolution::add`. Plans anew on every call.
///
/// @throw std::invalid_argument  as `sampled_readings`
[[nodiscard]] std::vector<double> fast_sampled_readings(const SensorArray& array,
                                                        const Material& material,
                                                        const TractionField& field);

}  // namespace tactile_net
