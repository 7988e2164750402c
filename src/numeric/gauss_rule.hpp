/// @file
/// The rules of Gauss and Legendre, compiled once: Boost's tables take longer to read than most
/// files. Private.
#pragma once

#include <cstddef>
#include <span>

namespace tactile_net {

/// One half of the rule on [-1, 1], from the middle on, of which the other half is the mirror
/// image; a rule of an odd number of points begins with 0.
struct GaussRule {
  std::span<const double> abscissa{}, weights{};
};

/// Of the numbers of points that gauss_rule.cpp lists; another does not link.
template <std::size_t points>
[[nodiscard]] GaussRule gauss_rule() noexcept;

}  // namespace tactile_net
