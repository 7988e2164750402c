/// @file
/// Private. Numbers of a page's data: no more digits than a picture needs.
#pragma once

#include <cmath>

#include "report/json/values.hpp"

namespace tactile_net::report {

/// The number with so many significant digits; what is not finite stays as it is.
[[nodiscard]] inline double rounded(double number, int digits) {
  if (number == 0.0 || !std::isfinite(number)) return number;
  const int shift = digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(number))));
  const double power = std::pow(10.0, std::abs(shift));
  const double result =
      shift >= 0 ? std::round(number * power) / power : std::round(number / power) * power;
  return std::isfinite(result) ? result : number;
}

[[nodiscard]] inline Json rounded_or_null(double number, int digits = 5) {
  return std::isfinite(number) ? Json(rounded(number, digits)) : Json(nullptr);
}

}  // namespace tactile_net::report
