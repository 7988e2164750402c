/// @file
/// How a line's surface and a skin's grid lay values along an axis so that taxels lie on some of
/// them. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "numeric/require.hpp"

namespace tactile_net {

/// @param spacing, margin  of values [m], as far as they are given
/// @throw std::invalid_argument  spacing is not > 0, margin is not >= 0
inline void check_spacing_and_margin(std::optional<double> spacing, std::optional<double> margin) {
  if (spacing) require_positive("spacing", *spacing);
  if (margin)
    require(*margin >= 0.0 && std::isfinite(*margin), "margin", "be >= 0 and finite", *margin);
}

/// ceil, but for rounding.
[[nodiscard]] inline double rounded_up(double ratio) { return std::ceil(ratio * (1.0 - 1e-12)); }

struct AxisSteps {
  double spacing;  ///< of values [m]
  double count;    ///< of steps over the length; 0 where there is no length
};

/// Whole steps over a length, as long as is wanted at most.
/// @param length  between taxels that are to lie on values [m]; 0: they are at one place
[[nodiscard]] inline AxisSteps steps_over(double length, double wanted) {
  if (!(length > 0.0)) return {wanted, 0.0};
  const double count = std::max(rounded_up(length / wanted), 1.0);
  return {length / count, count};
}

}  // namespace tactile_net
