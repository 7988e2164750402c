/// @file
/// The convolution of fft plans by the library's FFT (target tactile_net::spectral, which is GPL
/// where it was built with FFTW: numeric/fft.hpp).
#pragma once

#include "tactile_net/numeric/fft.hpp"
#include "tactile_net/realtime/convolution.hpp"

namespace tactile_net {

/// Makes convolutions for ContactEstimator's constructor. Each is for one thread; clones may be
/// made in any thread. Where the FFT is FFTW, other users of it in the process must not plan at the
/// same time.
[[nodiscard]] ConvolutionMaker fft_convolutions(FftEffort effort = FftEffort::estimate);

}  // namespace tactile_net
