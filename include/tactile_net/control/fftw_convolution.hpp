/// @file
/// The convolution of fft plans by FFTW (target tactile_net::spectral, hence GPL).
#pragma once

#include "tactile_net/realtime/convolution.hpp"

namespace tactile_net {

/// How FFTW chooses its algorithm.
enum class FftwEffort {
  estimate,  ///< by rule: in milliseconds, and the same bits in every process
  measure,  ///< by timing, for up to seconds: faster from about 1000 taxels on, but another process
            ///< may choose another algorithm and get other last bits
};

/// For ContactEstimator's constructor. What it makes is for one thread; clones share FFTW's plan
/// and may be made in any thread. Other users of FFTW in the process must not plan at the same
/// time.
[[nodiscard]] ConvolutionMaker fftw_convolutions(FftwEffort effort = FftwEffort::estimate);

}  // namespace tactile_net
