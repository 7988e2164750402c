/// @file
/// Private. What ripples of the tractions cause in every channel.
#pragma once

#include <complex>
#include <vector>

#include "tactile_net/inverse/line_problem.hpp"

namespace tactile_net {

/// What ripples exp(i k y) of the tractions cause in every channel: the kernels' exact transforms,
/// neither sampled nor cut off, each row divided by the channel's noise.
///
/// @param options     `channel_rms`, `unknowns` and `unknown_offsets` are read: these hide k = 0
/// @param wavenumber  k [1/m]
/// @return channels x unknowns, row-major [weighted reading per Pa]
/// @throw std::invalid_argument  as `make_problem`
[[nodiscard]] std::vector<std::complex<double>> transfer_matrix(const SensorArray& array,
                                                                const Material& material,
                                                                const LineProblemOptions& options,
                                                                double wavenumber);

}  // namespace tactile_net
