/// @file
/// Private. What ripples of the tractions cause in every channel of a skin.
#pragma once

#include <complex>
#include <vector>

#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// What ripples exp(i (k_y y + k_z z)) of p, q_y and q_z cause in each channel, each row divided by
/// its noise: channels x components, row-major [weighted reading per Pa]. For irregular skins a row
/// for each quantity and depth, as if each taxel were a share of one of them everywhere.
///
/// @param options  `components` and `channel_rms` are read
/// @throw std::invalid_argument  as `make_problem`
[[nodiscard]] std::vector<std::complex<double>> skin_symbol(const SkinArray& skin,
                                                            const Material& material,
                                                            const SkinProblemOptions& options,
                                                            double wavenumber_y,
                                                            double wavenumber_z);

}  // namespace tactile_net
