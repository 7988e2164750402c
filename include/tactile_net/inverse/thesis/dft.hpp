/// @file
/// The DFT approach of thesis chapter 3 (target tactile_net::spectral). One of the thesis' own
/// methods, kept to be compared with: `tikhonov` (inverse/reconstruction.hpp) and `FftTikhonov`
/// (inverse/fft_tikhonov.hpp) regularise, and know the array's ends.
///
/// Solves the circular system, not P f = b: K's rows are taken to wrap around after `count` points,
///
///     f = IDFT( DFT(g) / DFT(k D) )                        (thesis 3.8)
///
/// and the division has no regularisation. It is exact for loads whose readings have died away at
/// the array's ends, and amplifies whatever else there is: see `NoiseGain`.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/realtime/frame_status.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// What the division by the kernel's DFT does to errors of the readings.
struct NoiseGain {
  double largest = 1.0;       ///< max|DFT| / min|DFT|: worst relative amplification, >= 1, or inf
  std::size_t frequency = 0;  ///< where |DFT| is smallest, 0 ... count / 2
  std::size_t sign_changes = 0;  ///< entries whose sign differs from that at the largest |DFT|
};

enum class DftVerdict {
  ok,               ///< gain <= 1e4 and the DFT keeps its sign
  noise_amplified,  ///< gain > 1e4: readings need more than four digits for one digit of f
  sign_change,      ///< the truncated kernel's DFT changes sign: a null lies between frequencies
  cut_off,          ///< the readings are cut off by the array's ends, where the circle closes
};

/// The spelling in JSON and tables: "ok", "noise_amplified", "sign_change", "cut_off".
[[nodiscard]] std::string_view name(DftVerdict verdict) noexcept;

class DftInverse {
 public:
  /// Plans and transforms the kernel. O(count log count).
  ///
  /// @param gain_limit  largest noise gain that is accepted, >= 1
  /// @throw std::invalid_argument  array or material out of range; more than one channel
  /// @throw std::domain_error      the noise gain exceeds `gain_limit`; the text names the
  ///                               frequency, its wavelength and the gain
  DftInverse(const SensorArray& array, const Material& material, double gain_limit = 1e8);
  ~DftInverse();
  DftInverse(DftInverse&&) noexcept;
  DftInverse& operator=(DftInverse&&) noexcept;

  /// One frame, O(count log count). Uses buffers of its own: one object per thread. FFTW may
  /// allocate inside for counts with large prime factors.
  ///
  /// `too_large` if any traction would not be finite, or the transforms overflow on the way to it.
  ///
  /// @param readings   g, `count` values
  /// @param tractions  f [Pa], `count` values; untouched unless the status is `ok`
  FrameStatus solve(std::span<const double> readings, std::span<double> tractions) noexcept;

  [[nodiscard]] const NoiseGain& noise_gain() const noexcept;

  /// How far rounding may have moved a frame's tractions, over their 2-norm: the noise gain times
  /// the errors of the kernel and of three transforms, and of readings near the smallest double.
  [[nodiscard]] double forward_bound(std::span<const double> readings) const noexcept;

  /// Verdict on the array and the kernel, whatever the readings.
  [[nodiscard]] DftVerdict verdict() const noexcept;

  /// Verdict on one frame: as without readings, or `cut_off` if the readings at the array's ends,
  /// times the noise gain, exceed the peak reading. What is cut off there is folded in from the
  /// other end and amplified.
  [[nodiscard]] DftVerdict verdict(std::span<const double> readings) const noexcept;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace tactile_net
