/// @file
/// Numbers that are finite, and the one that is not. Private.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <span>

namespace tactile_net {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether |value| <= limit for every value, which NaN is not.
///
/// Magnitudes of doubles rise with their bits, infinity and NaN last, so that a difference of the
/// bits is negative as soon as one is too large: no branch, and compilers vectorise it.
///
/// @param limit  >= 0 and finite
[[nodiscard]] inline bool all_within(std::span<const double> values, double limit) noexcept {
  const auto most = std::bit_cast<std::uint64_t>(limit);
  std::uint64_t borrowed = 0;
  for (const double value : values)
    borrowed |= most - (std::bit_cast<std::uint64_t>(value) & ~(std::uint64_t{1} << 63));
  return borrowed >> 63 == 0;
}

[[nodiscard]] inline bool all_finite(std::span<const double> values) noexcept {
  return all_within(values, std::numeric_limits<double>::max());
}

}  // namespace tactile_net
