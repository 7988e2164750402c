/// @file
/// Private. Numbers that look random and are functions of a counter alone.
#pragma once

#include <cstdint>

namespace tactile_net {

/// By this much the counters of one sequence are apart.
inline constexpr std::uint64_t split_mix_step = 0x9e3779b97f4a7c15;

/// SplitMix64 (Steele, Lea and Flood 2014): one independent number per counter.
[[nodiscard]] constexpr std::uint64_t split_mix(std::uint64_t counter) noexcept {
  std::uint64_t x = counter + split_mix_step;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// -1 or 1: the last bit of it.
[[nodiscard]] constexpr double random_sign(std::uint64_t counter) noexcept {
  return (split_mix(counter) & 1) == 0 ? -1.0 : 1.0;
}

}  // namespace tactile_net
