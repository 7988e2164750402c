/// @file
/// Numbers with their units, with the prefix that keeps the number short; the same in every locale.
///
///     with_unit(4810, "Pa")           "4.81 kPa"
///     with_unit(0.98, "N/m")          "0.98 N/m"
///     with_unit(1.23e-3, 2e-5, "m")   "1.230 ± 0.020 mm"
///     scaled_unit(0.01, "m")          "mm", 1000: for the numbers along an axis up to 0.01 m
#pragma once

#include <string>
#include <string_view>

namespace tactile_net {

/// A unit with its prefix, and the factor from the bare unit to it.
struct ScaledUnit {
  std::string label{};  ///< "kPa"; UTF-8: "µm"
  double factor = 1.0;  ///< numbers in the bare unit times this: 1e-3
};

/// The prefix (p, n, µ, m, none, k, M, G, T) for numbers up to a size: none where the largest, as
/// written, is from 0.1 to below 1000, else that which leaves it one to three digits before the
/// point.
///
/// @param largest  the largest magnitude; none for 0 and what is not finite
/// @param unit     a unit without prefix: "Pa", "N/m"; empty: a number without unit has no prefix
/// @param digits   significant ones that will be written, >= 3: 999.7 with three is 1 k
[[nodiscard]] ScaledUnit scaled_unit(double largest, std::string_view unit, int digits = 3);

/// A number with its unit, `digits` significant digits as in `brief`; "-" for NaN.
[[nodiscard]] std::string with_unit(double number, std::string_view unit, int digits = 3);

/// A value and its standard deviation as in `plus_minus`, both in one unit.
[[nodiscard]] std::string with_unit(double value, double deviation, std::string_view unit);

}  // namespace tactile_net
