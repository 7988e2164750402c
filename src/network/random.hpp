/// @file
/// Random numbers that are functions of a seed, a trial and a place alone. Private.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "numeric/split_mix.hpp"

namespace tactile_net {

/// Uniform in -1 ... 1.
[[nodiscard]] inline double uniform(std::uint64_t seed, std::uint64_t trial,
                                    std::uint64_t place) noexcept {
  const std::uint64_t bits = split_mix(split_mix(split_mix(seed) ^ trial) ^ place);
  return std::ldexp(static_cast<double>(bits >> 11), -52) - 1.0;
}

/// Of mean 0 and variance 1 (Box and Muller 1958), independent of `uniform` of the same place.
[[nodiscard]] inline double normal(std::uint64_t seed, std::uint64_t trial,
                                   std::uint64_t place) noexcept {
  const std::uint64_t other = split_mix(~seed);
  // 0.5 - 0.5 u of u < 1 lies within (0, 1].
  const double radius = std::sqrt(-2.0 * std::log(0.5 - 0.5 * uniform(other, trial, 2 * place)));
  return radius * std::cos(std::numbers::pi * uniform(other, trial, 2 * place + 1));
}

}  // namespace tactile_net
