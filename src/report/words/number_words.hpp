/// @file
/// Numbers as several texts write them. Private.
#pragma once

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

[[nodiscard]] inline std::string in_unit(const std::optional<Units>& units, Dimension dimension,
                                         const Uncertain& number) {
  return in_unit(units, dimension, number.value, number.deviation);
}

}  // namespace tactile_net::report
