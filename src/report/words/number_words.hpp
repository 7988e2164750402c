/// @file
/// Numbers as several texts write them. Private.
#pragma once

#include <algorithm>
#include <array>
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

/// "(0.050 ± 0.010, 0.05 ± 0.02, -0.448 ± 0.017) N": components in one unit, the deviations of all;
/// where these are 0, "(0, 2.5, 30) mm".
[[nodiscard]] inline std::string vector_in_words(const std::optional<Units>& units,
                                                 Dimension dimension,
                                                 const std::array<Uncertain, 3>& vector) {
  double largest = 0.0;
  for (const Uncertain& one : vector) largest = std::max(largest, std::abs(one.value));
  const auto [label, factor] = units ? axis_unit(units, dimension, largest) : ScaledUnit{"", 1.0};
  std::string text;
  for (const auto& [value, deviation, interval] : vector)
    text +=
        (text.empty() ? "(" : ", ") +
        (deviation > 0.0 ? plus_minus(value * factor, deviation * factor) : brief(value * factor));
  return text + ')' + (label.empty() ? "" : " ") + label;
}

/// A place, or another vector that is exact.
[[nodiscard]] inline std::string vector_in_words(const std::optional<Units>& units,
                                                 Dimension dimension,
                                                 const std::array<double, 3>& vector) {
  return vector_in_words(
      units, dimension,
      std::array{Uncertain{vector[0]}, Uncertain{vector[1]}, Uncertain{vector[2]}});
}

}  // namespace tactile_net::report
