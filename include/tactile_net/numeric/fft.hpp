/// @file
/// The FFT that tactile_net::spectral was built with (TACTILE_NET_FFT). Both give the same numbers
/// to rounding; what differs is the time, and under which licence the program may be passed on.
#pragma once

#include <string_view>

namespace tactile_net {

enum class FftLibrary {
  fftw,   ///< FFTW: the fastest; GPL
  eigen,  ///< Eigen's own, kissfft: three to eight times FFTW's time; MPL 2.0
};

[[nodiscard]] FftLibrary fft_library() noexcept;

/// "FFTW (GPL)" or "Eigen (MPL 2.0)".
[[nodiscard]] std::string_view name(FftLibrary library) noexcept;

/// How the FFT chooses its algorithm. FFTW alone has several.
enum class FftEffort {
  estimate,  ///< by rule: in milliseconds, and the same bits in every process
  /// By timing, for up to seconds: faster from about 1000 taxels on, but another process may choose
  /// another algorithm and get other last bits.
  measure,
};

}  // namespace tactile_net
