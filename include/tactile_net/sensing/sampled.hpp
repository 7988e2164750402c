/// @file
/// The forward model of the thesis: a discrete sum over the taxels' positions.
///
///     g(n) = sum_i k(y_n - y_i) D f(i),  D = pitch          (thesis 3.4)
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net {

/// k(m D) D for m = -(count - 1) ... count - 1: the 2 count - 1 distinct entries of one Toeplitz
/// block of K, entry m at index m + count - 1 [reading per Pa].
[[nodiscard]] std::vector<double> sampled_kernel(const Channel& channel, Traction component,
                                                 const Material& material, std::size_t count,
                                                 double pitch);

/// out(n) += sum_i kernel(n - i) in(i), `count` values in and out, by the sum itself: O(count^2).
void add_convolution(std::span<const double> kernel, std::span<const double> in,
                     std::span<double> out) noexcept;

/// The readings of every channel, channels x count, caused by `field`: O(channels * count^2).
///
/// @throw std::invalid_argument  the array or the material is out of range, or the field's sizes
///                               do not fit the array
[[nodiscard]] std::vector<double> sampled_readings(const SensorArray& array,
                                                   const Material& material,
                                                   const TractionField& field);

}  // namespace tactile_net
