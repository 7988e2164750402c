/// @file
/// Whether a contact may reach beyond what is seen: the rule of controllers and of solvers.
/// Private.
#pragma once

#include <algorithm>
#include <span>

namespace tactile_net {

/// Whether the border is pressed nearly as hard as any place. What presses beside it is then not
/// known, and the force that is found is a lower bound: under contacts that end at the outermost
/// taxels the border has at most half of the highest pressure, under those whose middle lies there
/// nine tenths.
///
/// @param pressure  of every place, one at least
/// @param border    places
[[nodiscard]] inline bool presses_at_border(std::span<const double> pressure,
                                            const auto& border) noexcept {
  constexpr double nearly = 0.7;
  double there = 0.0;
  for (const auto place : border) there = std::max(there, pressure[place]);
  // Mostly a place is found soon that is pressed much more.
  return there > 0.0 && std::none_of(pressure.begin(), pressure.end(),
                                     [&](double value) { return there < nearly * value; });
}

}  // namespace tactile_net
