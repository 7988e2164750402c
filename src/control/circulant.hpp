/// @file
/// The convolution that a mirror-symmetric block is away from its ends. Private.
///
/// Of M = P^-1 K' only what is near the array's two ends knows of them: the middle of each diagonal
/// is the endless array's, to within what the kernel still is half an array away. (A mean over
/// whole diagonals mixes the ends into every lag: M minus it has full rank.)
#pragma once

#include <cstddef>
#include <vector>

#include "numeric/eigen.hpp"

namespace tactile_net {

/// A size >= `least` that FFTW is fast at without timing: 4, 5 or 6 times a power of two.
[[nodiscard]] std::size_t transform_size(std::size_t least) noexcept;

/// DFT of the circulant on `size` points whose lags are the block's diagonals at their middle, as
/// in `ProductPlan::spectra`. Where two lags fall on the same index modulo `size`, the shorter one
/// is taken.
///
/// @param block  n x n, J B J = sign B
/// @param size   an even number, >= n
[[nodiscard]] std::vector<double> circulant_spectrum(const Eigen::MatrixXd& block, int sign,
                                                     std::size_t size);

/// The n x n corner of the circulant with that spectrum, with the rounding of its entries only.
[[nodiscard]] Eigen::MatrixXd circulant_corner(const std::vector<double>& spectrum, int sign,
                                               Eigen::Index n);

}  // namespace tactile_net
