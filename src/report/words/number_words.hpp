/// @file
/// Numbers as several texts write them. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {

[[nodiscard]] inline std::string brief_or_dash(const std::optional<double>& number) {
  return number ? brief(*number) : "-";
}

[[nodiscard]] inline double in_degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

[[nodiscard]] inline std::string degrees_in_words(double radians) {
  return brief(in_degrees(radians)) + " deg";
}

[[nodiscard]] inline std::string length_in_words(const std::optional<Units>& units, double length) {
  return in_unit(units, Dimension::length, length);
}

/// "0.506 N, 95 %: 0.493 to 0.519", rounded by the interval; without one "0.506 ± 0.007 N".
[[nodiscard]] inline std::string in_unit(const std::optional<Units>& units, Dimension dimension,
                                         const Uncertain& number) {
  if (number.interval && number.interval->low < number.interval->high) {
    const auto& [level, low, high] = *number.interval;
    const double largest = std::max({std::abs(number.value), std::abs(low), std::abs(high)});
    const auto [label, factor] = units ? axis_unit(units, dimension, largest) : ScaledUnit{"", 1.0};
    const double power = std::floor(std::log10(0.25 * (high - low) * factor));
    const auto as_text = [&, scale = factor](double one) {
      return std::abs(power) > 4.0 ? brief(one * scale, 4)
                                   : fixed(one * scale, static_cast<int>(std::max(-power, 0.0)));
    };
    return as_text(number.value) + (label.empty() ? "" : " ") + label + ", " +
           brief(100.0 * level) + " %: " + as_text(low) + " to " + as_text(high);
  }
  return in_unit(units, dimension, number.value, number.deviation);
}

}  // namespace tactile_net::report
